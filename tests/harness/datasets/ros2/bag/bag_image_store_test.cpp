// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_image_store.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/ros2/cdr/cdr_writer.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "tests/support/small_bag.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

/// An image in CDR with any step.
std::string padded(std::uint32_t width, std::uint32_t height, const std::string& encoding,
                   std::uint32_t step, const std::string& bytes) {
  CdrWriter out;
  out.put(std::int32_t{1});
  out.put(std::uint32_t{0});
  out.put_text("camera");
  out.put(height);
  out.put(width);
  out.put_text(encoding);
  out.put(std::uint8_t{0});
  out.put(step);
  out.put_bytes(bytes);
  return out.take();
}

cv::Mat grey(const std::string& message) {
  return grey_of_message(message, false, "image");
}

TEST(BagImageStoreTest, RowsMayBePadded) {
  const cv::Mat image = grey(padded(3, 2, "mono8", 4, "abc.def."));
  ASSERT_EQ(image.size(), cv::Size(3, 2));
  EXPECT_EQ(image.type(), CV_8UC1);
  EXPECT_EQ(image.at<char>(0, 2), 'c');
  EXPECT_EQ(image.at<char>(1, 0), 'd');
}

/// The SLAM core's grey, whatever the order of the channels.
TEST(BagImageStoreTest, ColoursBecomeTheSameGrey) {
  const cv::Mat rgb(1, 1, CV_8UC3, cv::Scalar(200, 100, 50));
  const auto expected = to_grey(rgb).at<std::uint8_t>(0, 0);
  const std::string red_first = "\xc8\x64\x32", blue_first = "\x32\x64\xc8";
  EXPECT_EQ(grey(padded(1, 1, "rgb8", 3, red_first)).at<std::uint8_t>(0, 0), expected);
  EXPECT_EQ(grey(padded(1, 1, "bgr8", 3, blue_first)).at<std::uint8_t>(0, 0), expected);
  EXPECT_EQ(grey(padded(1, 1, "rgba8", 4, red_first + "\xff")).at<std::uint8_t>(0, 0), expected);
  EXPECT_EQ(grey(padded(1, 1, "bgra8", 4, blue_first + "\xff")).at<std::uint8_t>(0, 0), expected);
}

TEST(BagImageStoreTest, CompressedImagesAreDecoded) {
  cv::Mat image(8, 8, CV_8UC1, cv::Scalar(0));
  image.at<std::uint8_t>(3, 4) = 77;
  const std::string png = encode(
      RosCompressedImage{test::header_at(1, ""), "png", encode_image(image, ImageKind::kPng)});
  EXPECT_EQ(cv::norm(grey_of_message(png, true, "image"), image, cv::NORM_INF), 0);
  EXPECT_THAT(error_of([] {
                grey_of_message(encode(RosCompressedImage{test::header_at(1, ""), "png", "noise"}),
                                true, "image");
              }),
              HasSubstr("image"));
}

TEST(BagImageStoreTest, SizesAreHeldAgainstTheData) {
  const std::string six = "abcdef";
  EXPECT_THAT(error_of([&] { grey(padded(3, 2, "16UC1", 3, six)); }), HasSubstr("found '16UC1'"));
  EXPECT_THAT(error_of([&] { grey(padded(3, 3, "mono8", 3, six)); }),
              HasSubstr("expected 3 rows of 3 bytes or more, found 6 bytes in rows of 3"));
  EXPECT_THAT(error_of([&] { grey(padded(3, 2, "rgb8", 3, six)); }),
              HasSubstr("expected 2 rows of 9 bytes or more"));
  EXPECT_THAT(error_of([&] { grey(padded(0, 2, "mono8", 3, six)); }), HasSubstr("found 0 x 2"));
  EXPECT_THAT(error_of([&] { grey(padded(0xffffffff, 0xffffffff, "mono8", 0xffffffff, six)); }),
              HasSubstr("found 4294967295 x 4294967295"));
  EXPECT_THAT(error_of([&] { grey(padded(10'000, 10'000, "mono8", 0xffffffff, six)); }),
              HasSubstr("found 6 bytes"));
}

}  // namespace
}  // namespace vinebench::harness
