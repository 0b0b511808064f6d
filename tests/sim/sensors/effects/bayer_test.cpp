// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/bayer.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "tests/support/effect_camera.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

constexpr std::array kPatterns{BayerPattern::kRggb, BayerPattern::kGrbg, BayerPattern::kGbrg,
                               BayerPattern::kBggr};

/// The patterns are named for their first two rows: of red 10, green 20 and blue 30, "gbrg" keeps
/// 20 30 over 10 20.
TEST(BayerTest, EachPatternKeepsTheColoursOfItsName) {
  const cv::Mat rgb(5, 3, CV_8UC3, cv::Scalar(10, 20, 30));
  const std::vector<std::string> names = yaml_names(BayerPattern{});
  for (const BayerPattern pattern : kPatterns) {
    const std::string& name = names.at(static_cast<std::size_t>(pattern));
    const cv::Mat sites = mosaic(rgb, pattern);
    ASSERT_EQ(sites.type(), CV_8UC1);
    ASSERT_EQ(sites.size(), rgb.size());
    for (int y = 0; y < sites.rows; ++y) {
      for (int x = 0; x < sites.cols; ++x) {
        const char filter = name[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
        const int expected = filter == 'r' ? 10 : filter == 'g' ? 20 : 30;
        EXPECT_EQ(sites.at<std::uint8_t>(y, x), expected) << name << " " << x << " " << y;
      }
    }
  }
}

TEST(BayerTest, AnEvenColourSurvivesFiltersAndInterpolation) {
  const cv::Mat rgb(40, 60, CV_8UC3, cv::Scalar(200, 120, 40));
  for (const BayerPattern pattern : kPatterns) {
    const cv::Mat back = demosaic(mosaic(rgb, pattern), pattern);
    EXPECT_EQ(test::different_values(back, rgb), 0) << static_cast<int>(pattern);
  }
}

TEST(BayerTest, ASensorWithoutFiltersHasNoEffects) {
  EXPECT_EQ(make_colour_filters(BayerPattern::kNone), nullptr);
  EXPECT_EQ(make_colour_interpolation(BayerPattern::kNone), nullptr);
  EXPECT_NE(test::error_of([] { mosaic(cv::Mat(2, 2, CV_8UC3), BayerPattern::kNone); }), "");
}

TEST(BayerTest, TheEffectsAreFiltersAndInterpolation) {
  cv::Mat codes(40, 60, CV_8UC3, cv::Scalar(200, 120, 40));
  make_colour_filters(BayerPattern::kBggr)->apply(codes, {});
  ASSERT_EQ(codes.type(), CV_8UC1);
  EXPECT_EQ(codes.at<std::uint8_t>(0, 0), 40);
  make_colour_interpolation(BayerPattern::kBggr)->apply(codes, {});
  ASSERT_EQ(codes.type(), CV_8UC3);
  EXPECT_EQ(codes.at<cv::Vec3b>(7, 9), cv::Vec3b(200, 120, 40));
}

}  // namespace
}  // namespace vinebench::sim
