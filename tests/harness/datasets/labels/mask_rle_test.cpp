// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/mask_rle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/util/random.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// Runs of an image's pixels that are not 0, down the columns.
Runs runs_of(const cv::Mat& mask) {
  Runs runs;
  for (int x = 0; x < mask.cols; ++x) {
    for (int y = 0; y < mask.rows; ++y) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      const std::int64_t at = std::int64_t{x} * mask.rows + y;
      if (!runs.empty() && runs.back().end == at) {
        ++runs.back().end;
      } else {
        runs.push_back({at, at + 1});
      }
    }
  }
  return runs;
}

TEST(RunLengthTest, CountsAreCompressedAsPycocotoolsDoes) {
  // An image of 3 rows and 4 columns with its second column set: 3 without, 3 with, 6 without.
  // Each is one group of five bits: '3', '3', and for the third the count itself, '6'.
  EXPECT_EQ(compress({{3, 6}}, 12), "336");
  // 100 = 0b00011'00100: the low group 4 + 32 (more follow) = 36, '0' + 36 = 'T', then 3: '3'.
  EXPECT_EQ(compress({{100, 200}}, 300), "T3T3T3");
  // The fourth count less the second: 1 - 5 = -4, in five bits 28 with its sign set: '0' + 28 =
  // 'L'.
  EXPECT_EQ(compress({{0, 5}, {7, 8}}, 8), "052L");
}

TEST(RunLengthTest, MasksComeBack) {
  const RandomStream random(3, "masks");
  for (int trial = 0; trial < 20; ++trial) {
    cv::Mat mask(37, 53, CV_8UC1);
    for (int i = 0; i < 37 * 53; ++i) {
      const auto counter = static_cast<std::uint64_t>(trial * 10'000 + i);
      mask.data[i] = random.uniform(counter) < 0.05 * trial ? 255 : 0;
    }
    const Runs runs = runs_of(mask);
    const std::string text = compress(runs, 37 * 53);
    EXPECT_EQ(cv::norm(mask_of(decompress(text, 37 * 53), mask.size()), mask, cv::NORM_INF), 0);
    EXPECT_EQ(area_of(runs), cv::countNonZero(mask));
    cv::Rect box;
    for (int y = 0; y < 37; ++y) {
      for (int x = 0; x < 53; ++x) {
        if (mask.at<std::uint8_t>(y, x) != 0) box |= cv::Rect(x, y, 1, 1);
      }
    }
    EXPECT_EQ(box_of(runs, 37), box);
  }
}

TEST(RunLengthTest, MasksAreUnited) {
  const Runs runs = united({{{0, 2}, {8, 9}}, {{2, 5}}, {{6, 7}}});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].end, 5);
  EXPECT_EQ(area_of(runs), 7);
}

TEST(RunLengthTest, DamagedCountsAreErrors) {
  EXPECT_THAT(test::error_of([] { decompress("336", 13); }), HasSubstr("counts of 12 pixels"));
  EXPECT_THAT(test::error_of([] { decompress("33T", 12); }), HasSubstr("not compressed counts"));
  EXPECT_THAT(test::error_of([] { decompress("3\x01", 12); }), HasSubstr("not compressed counts"));
  // 100 without where the image has 12 pixels.
  EXPECT_THAT(test::error_of([] { decompress("T3", 12); }), HasSubstr("counts from 0 to 12"));
}

}  // namespace
}  // namespace vinebench::harness
