// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/image_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/util/random.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

cv::Mat noise(int rows, int columns, int type) {
  cv::Mat image(rows, columns, type);
  const RandomStream random(1, "noise");
  const auto bytes = static_cast<std::uint64_t>(image.total() * image.elemSize());
  for (std::uint64_t i = 0; i < bytes; ++i) {
    image.data[i] = static_cast<std::uint8_t>(random.bits(i));
  }
  return image;
}

cv::Mat decoded(const std::string& bytes) {
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  cv::Mat image = cv::imdecode(data, cv::IMREAD_UNCHANGED);
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  return image;
}

TEST(PngWriterTest, LibpngReadsTheSamePixels) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3}) {
    for (const cv::Size size :
         {cv::Size(1, 1), cv::Size(53, 37), cv::Size(1, 9), cv::Size(300, 2)}) {
      const cv::Mat image = noise(size.height, size.width, type);
      for (const PngContent content : {PngContent::kAreas, PngContent::kNoise}) {
        const cv::Mat back = decoded(encode_png(image, content));
        ASSERT_EQ(back.type(), type);
        ASSERT_EQ(back.size(), size);
        EXPECT_EQ(cv::norm(back, image, cv::NORM_INF), 0);
      }
    }
  }
  // Rows of a larger image are not next to each other.
  const cv::Mat part = noise(40, 40, CV_8UC3)(cv::Rect(3, 5, 20, 10));
  EXPECT_EQ(cv::norm(decoded(encode_png(part)), part, cv::NORM_INF), 0);
}

TEST(PngWriterTest, FlatImagesAreSmall) {
  EXPECT_LT(encode_png(cv::Mat(480, 752, CV_8UC1, cv::Scalar(5))).size(), 5000u);
}

TEST(PngWriterTest, OtherImagesAreErrors) {
  for (const cv::Mat& bad : {cv::Mat(), cv::Mat(2, 2, CV_32FC1), cv::Mat(2, 2, CV_8UC4)}) {
    EXPECT_THAT(test::error_of([&] { encode_png(bad); }), testing::HasSubstr("PNG: expected"));
  }
}

TEST(ImageCodecTest, WebpIsWithoutLossAndJpegNearly) {
  cv::Mat smooth;
  cv::GaussianBlur(noise(48, 64, CV_8UC3), smooth, {}, 4);
  EXPECT_EQ(cv::norm(decoded(encode_image(smooth, ImageKind::kWebp)), smooth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(decoded(encode_image(smooth, ImageKind::kPng)), smooth, cv::NORM_INF), 0);
  // Quality 95 of an image without edges: a few grey levels.
  EXPECT_LE(cv::norm(decoded(encode_image(smooth, ImageKind::kJpeg)), smooth, cv::NORM_INF), 12);
}

TEST(ImageCodecTest, FlowIsMiddleburys) {
  cv::Mat flow(1, 2, CV_32FC2);
  flow.at<cv::Vec2f>(0, 0) = {1.5f, -2};
  flow.at<cv::Vec2f>(0, 1) = cv::Vec2f::all(std::numeric_limits<float>::quiet_NaN());
  const std::string bytes = encode_flo(flow);
  ASSERT_EQ(bytes.size(), 12u + 16);
  std::array<float, 4> values{};
  std::memcpy(values.data(), bytes.data() + 12, 16);
  EXPECT_THAT(values, testing::ElementsAre(1.5f, -2, 1e10f, 1e10f));
}

}  // namespace
}  // namespace vinebench::harness
