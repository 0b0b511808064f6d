// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/processing/jpeg.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "core/files/files.h"
#include "core/util/random.h"
#include "tests/support/effect_camera.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

cv::Mat compressed(const cv::Mat& codes, int quality) {
  cv::Mat image = codes.clone();
  make_jpeg({quality})->apply(image, {});
  EXPECT_EQ(image.type(), CV_8UC3);
  EXPECT_EQ(image.size(), codes.size());
  return image;
}

/// Noise over a ramp; sides that are no multiple of a block's.
cv::Mat textured() {
  cv::Mat image(117, 203, CV_8UC3);
  const RandomStream draw(1, "jpeg_test");
  std::uint64_t index = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double code = x + 50 * draw.uniform(index++);
        image.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<std::uint8_t>(code);
      }
    }
  }
  return image;
}

/// A block's mean is kept in steps of its table's first number, 16 at a quality of 50, by 8: of
/// even grey every second code is left. At 25 the table is twice as coarse.
TEST(JpegTest, TheQualityIsThatOfTheStandardsTables) {
  for (const auto& [quality, step] : {std::pair(50, 2), std::pair(25, 4)}) {
    for (int code = 0; code < 256; ++code) {
      const cv::Mat even(16, 16, CV_8UC3, cv::Scalar::all(code));
      const cv::Mat image = compressed(even, quality);
      const int kept = image.at<cv::Vec3b>(8, 8)[1];
      EXPECT_LE(std::abs(kept - code), step / 2) << code;
      if (kept < 255) {
        EXPECT_EQ(kept % step, 0) << code;
      }
      EXPECT_EQ(test::different_values(image, cv::Mat(16, 16, CV_8UC3, cv::Scalar::all(kept))), 0);
    }
  }
}

/// Columns of two colours of one brightness (0.299 R + 0.587 G + 0.114 B = 126.2 and 126.4) become
/// their mean, with an error of about 1 from rounding to Y, Cb, Cr and back.
TEST(JpegTest, ColoursHaveHalfTheResolution) {
  cv::Mat columns(32, 32, CV_8UC3);
  for (int x = 0; x < 32; ++x) {
    columns.col(x).setTo(x % 2 == 0 ? cv::Scalar(180, 100, 120) : cv::Scalar(100, 141, 120));
  }
  const cv::Mat image = compressed(columns, 100);
  for (int x = 8; x < 24; ++x) {
    EXPECT_NEAR(image.at<cv::Vec3b>(15, x)[0], 140, 2);
    EXPECT_NEAR(image.at<cv::Vec3b>(15, x)[1], 120.5, 2);
  }
}

TEST(JpegTest, ALowerQualityIsFartherFromTheImage) {
  const cv::Mat image = textured();
  double last = 0;
  for (const int quality : {100, 90, 60, 20, 1}) {
    const double error = cv::norm(compressed(image, quality), image, cv::NORM_L1);
    EXPECT_GT(error, last) << quality;
    last = error;
  }
}

TEST(JpegTest, WithoutAQualityThereIsNoEffect) {
  EXPECT_EQ(make_jpeg({}), nullptr);
}

constexpr const char* kResult = "VINEBENCH_JPEG_RESULT";

std::string all_qualities() {
  std::string bytes;
  for (const int quality : {5, 30, 75, 92, 100}) {
    const cv::Mat image = compressed(textured(), quality);
    bytes.append(reinterpret_cast<const char*>(image.data), image.total() * image.elemSize());
  }
  return bytes;
}

/// Run by the next test in a process of its own, since the choice of instructions is made once.
TEST(JpegTest, DISABLED_WritesItsResult) {
  const char* file = std::getenv(kResult);
  ASSERT_NE(file, nullptr);
  write_file_atomically(file, all_qualities());
}

TEST(JpegTest, TheBytesAreThoseWithoutVectorInstructions) {
  const test::TestFolder folder;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  for (const char* instructions : {"JSIMD_FORCENONE=1", "JSIMD_FORCESSE2=1"}) {
    const std::filesystem::path result = folder / instructions;
    const std::string command = fmt::format(
        "env {} {}='{}' '{}' --gtest_also_run_disabled_tests "
        "--gtest_filter=JpegTest.DISABLED_WritesItsResult > /dev/null",
        instructions, kResult, result.string(), program.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_TRUE(read_file(result) == all_qualities()) << instructions;
  }
}

}  // namespace
}  // namespace vinebench::sim
