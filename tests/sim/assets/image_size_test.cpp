// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/image_size.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

namespace vinebench::sim {
namespace {

std::string encoded(const char* ending) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, cv::Mat(7, 300, CV_8UC3, cv::Scalar(10, 20, 30)), bytes);
  return {bytes.begin(), bytes.end()};
}

// 300 needs two bytes, so that the byte order counts.
TEST(ImageSizeTest, IsReadFromTheHeader) {
  for (const char* ending : {".png", ".jpg", ".tiff"}) {
    const auto size = image_size(encoded(ending));
    ASSERT_TRUE(size) << ending;
    EXPECT_EQ(*size, cv::Size2d(300, 7)) << ending;
  }
}

// A TIFF with its most significant bytes first: a directory at byte 8 with width (256) and height
// (257), the one as a short, the other as a long.
TEST(ImageSizeTest, ATiffHasItsOwnByteOrder) {
  const std::string bytes(
      "MM\0*\0\0\0\x08"
      "\0\x02"
      "\x01\0\0\x03\0\0\0\x01\x01\x2c\0\0"
      "\x01\x01\0\x04\0\0\0\x01\0\0\0\x07",
      34);
  EXPECT_EQ(image_size(bytes), cv::Size2d(300, 7));
}

TEST(ImageSizeTest, OtherBytesHaveNone) {
  EXPECT_FALSE(image_size(""));
  EXPECT_FALSE(image_size("GIF89a"));
  EXPECT_FALSE(image_size(encoded(".jpg").substr(0, 8)));  // before its size is said
}

}  // namespace
}  // namespace vinebench::sim
