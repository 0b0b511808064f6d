// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/image_size.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "core/util/error.h"

namespace vinebench {
namespace {

std::string encoded(const char* ending) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, cv::Mat(7, 300, CV_8UC3, cv::Scalar(10, 20, 30)), bytes);
  return {bytes.begin(), bytes.end()};
}

// 300 needs two bytes, so that the byte order counts.
TEST(ImageSizeTest, IsReadFromTheHeader) {
  for (const char* ending : {".png", ".jpg", ".tiff", ".webp", ".bmp", ".ppm"}) {
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

// The three kinds of WebP, each with 300 (0x12c) by 7; the last two are stored minus one.
TEST(ImageSizeTest, OfEachKindOfWebp) {
  const std::string lossy("RIFF....WEBPVP8 ....---\x9d\x01\x2a\x2c\x01\x07\0", 30);
  // 299 | 6 << 14 = 0x1812b
  const std::string lossless("RIFF....WEBPVP8L....\x2f\x2b\x81\x01\0", 25);
  const std::string extended("RIFF....WEBPVP8X........\x2b\x01\0\x06\0\0", 30);
  for (const std::string& bytes : {lossy, lossless, extended}) {
    EXPECT_EQ(image_size(bytes), cv::Size2d(300, 7)) << bytes.substr(12, 4);
  }
}

TEST(ImageSizeTest, OfNetpbmWithComments) {
  EXPECT_EQ(image_size("P5\n# 9 9\n300 # wide\n7\n255\n"), cv::Size2d(300, 7));
  EXPECT_FALSE(image_size("P5\n300"));
  EXPECT_FALSE(image_size("P5 # 300 7"));
}

// 10 000 by 10 000 pixels are 100 million.
TEST(ImageSizeTest, MorePixelsThanTheLimitAreAnError) {
  EXPECT_NO_THROW(check_image_size("P5 10000 10000 255\n", "a.pgm"));
  EXPECT_THAT([] { check_image_size("P5 10001 10000 255\n", "a.pgm"); },
              testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("a.pgm"),
                                                           testing::HasSubstr("10001 x 10000"))));
  EXPECT_THROW(check_image_size("P5 0 7 255\n", "a.pgm"), Error);
  EXPECT_THROW(check_image_size("text", "a.pgm"), Error);
}

TEST(ImageSizeTest, OtherBytesHaveNone) {
  EXPECT_FALSE(image_size("RIFF....WEBP"));
  EXPECT_FALSE(image_size(""));
  EXPECT_FALSE(image_size("GIF89a"));
  EXPECT_FALSE(image_size(encoded(".jpg").substr(0, 8)));  // before its size is said
}

}  // namespace
}  // namespace vinebench
