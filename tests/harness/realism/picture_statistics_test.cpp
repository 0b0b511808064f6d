// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/picture_statistics.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

constexpr int kWidth = 376;
constexpr int kHeight = 240;

cv::Mat plain(const cv::Scalar& rgb) {
  return {kHeight, kWidth, CV_8UC3, rgb};
}

/// Grey noise of that standard deviation, each pixel by itself.
cv::Mat noise(double sigma) {
  const RandomStream stream(1, "noise");
  cv::Mat rgb = plain({0, 0, 0});
  for (int i = 0; i < rgb.rows * rgb.cols; ++i) {
    const auto code =
        cv::saturate_cast<std::uint8_t>(128 + sigma * stream.normal(static_cast<std::uint64_t>(i)));
    rgb.at<cv::Vec3b>(i / rgb.cols, i % rgb.cols) = {code, code, code};
  }
  return rgb;
}

double value(const PictureStatistics& statistics, const std::string& name) {
  for (const auto& [key, found] : statistics) {
    if (key == name) return found;
  }
  ADD_FAILURE() << name;
  return 0;
}

bool has(const PictureStatistics& statistics, const std::string& name) {
  return std::ranges::any_of(statistics, [&](const auto& entry) { return entry.first == name; });
}

TEST(PictureStatisticsTest, APlainPictureHasNothing) {
  const PictureStatistics found = picture_statistics(plain({100, 100, 100}));
  EXPECT_EQ(value(found, "mean"), 100);
  EXPECT_EQ(value(found, "rms_contrast"), 0);
  EXPECT_EQ(value(found, "fast20"), 0);
  EXPECT_EQ(value(found, "fast20_empty_cells"), 1);
  EXPECT_EQ(value(found, "sift"), 0);
  EXPECT_EQ(value(found, "grad_p99"), 0);
  EXPECT_EQ(value(found, "textureless_cells"), 1);
  EXPECT_EQ(value(found, "sat"), 0);
  EXPECT_FALSE(has(found, "veg_hue"));
  EXPECT_FALSE(has(found, "self_d1"));
}

// Power is even over all frequencies, and neighbours are independent: 1 px. The slope's error over
// 39 rings of some hundred frequencies each is some hundredths.
TEST(PictureStatisticsTest, NoiseIsWhite) {
  const PictureStatistics found = picture_statistics(noise(20));
  EXPECT_NEAR(value(found, "mean"), 128, 0.5);
  EXPECT_NEAR(value(found, "rms_contrast"), 20.0 / 128, 0.005);
  EXPECT_NEAR(value(found, "slope"), 0, 0.1);
  EXPECT_NEAR(value(found, "hf_db"), 0, 0.3);
  EXPECT_EQ(value(found, "corr_len"), 1);
  // Deviations in windows of 256 px scatter by 1 / sqrt(512) of 20.
  EXPECT_NEAR(value(found, "local_sd"), 20, 0.5);
  EXPECT_GT(value(found, "fast20"), 100);
  // ORB leaves out a border of 31 px: an even spread over 62 % of 160 cells is 1 + ln 0.62 / ln 160
  // = 0.906, less what counts of about ten in a cell scatter.
  EXPECT_NEAR(value(found, "orb_spread"), 0.88, 0.026);
}

// Sobel's kernel sums a step of 40 four times; by eight that is 20, in the two columns beside it.
TEST(PictureStatisticsTest, AStepHasItsGradient) {
  cv::Mat rgb = plain({100, 100, 100});
  for (int x = 8; x < kWidth; x += 16)
    rgb.colRange(x, std::min(x + 8, kWidth)) = cv::Scalar::all(140);
  const PictureStatistics found = picture_statistics(rgb);
  EXPECT_EQ(value(found, "grad_p50"), 0);
  EXPECT_NEAR(value(found, "grad_p90"), 20, 1e-5);
  EXPECT_NEAR(value(found, "grad_p99_over_p50"), 200, 1e-4);  // over 0.1 at least
}

// Hues of (60, 120, 30) and (30, 120, 60): 60 * (2 + (30 - 60) / 90) = 100 degrees, and 140; one
// quarter of the picture each, so their deviation is 20 and the median one of both.
TEST(PictureStatisticsTest, VegetationIsWhatIsGreen) {
  cv::Mat rgb = plain({60, 120, 30});
  rgb.rowRange(0, kHeight / 4) = cv::Scalar(30, 120, 60);
  rgb.rowRange(kHeight / 2, kHeight) = cv::Scalar(120, 110, 100);  // soil: excess 0
  const PictureStatistics found = picture_statistics(rgb);
  EXPECT_NEAR(value(found, "veg_hue"), 120, 20.1);
  EXPECT_NEAR(value(found, "veg_hue_sd"), 20, 1);
  EXPECT_NEAR(value(found, "veg_sat"), 0.75, 0.01);
  EXPECT_NEAR(value(found, "veg_val_sd"), 0, 1e-6);
  // Half of the picture has (240 - 90) / 211, soil (220 - 220) / 331.
  EXPECT_NEAR(value(found, "exg"), 0.5 * 150 / 211, 1e-4);
}

TEST(PictureStatisticsTest, BurntOutAndBlackAreShares) {
  cv::Mat rgb = plain({128, 128, 128});
  rgb.rowRange(0, 24) = cv::Scalar::all(255);
  rgb.rowRange(24, 36) = cv::Scalar::all(12);
  const PictureStatistics found = picture_statistics(rgb);
  EXPECT_NEAR(value(found, "white"), 0.1, 1e-12);
  EXPECT_NEAR(value(found, "black"), 0.05, 1e-12);
}

// 3000 x 3000 to 752 wide is 752 high; the middle 480 rows remain. 1500 x 500 is 251 high.
TEST(PictureStatisticsTest, PicturesAreScaledAndCut) {
  EXPECT_EQ(standard_picture(cv::Mat(3000, 3000, CV_8UC3), 752).size(), cv::Size(752, 480));
  EXPECT_EQ(standard_picture(cv::Mat(500, 1500, CV_8UC3), 752).size(), cv::Size(752, 251));
}

}  // namespace
}  // namespace vinebench::harness
