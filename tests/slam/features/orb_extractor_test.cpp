// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/orb_extractor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "core/util/error.h"
#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

constexpr int kWidth = 480;
constexpr int kHeight = 360;

OrbConfig small_config() {
  OrbConfig config;
  config.features = 600;
  return config;
}

cv::Mat textured(double sigma = 0, std::uint64_t seed = 0) {
  const SyntheticTexture texture(7);
  return render_image(kWidth, kHeight, texture, sigma, seed);
}

/// Similarity that takes a point of the first image to the second: about the middle.
struct Similarity {
  double angle = 0;
  double scale = 1;
  cv::Point2d operator()(double x, double y) const {
    const double dx = x - (kWidth - 1) / 2.0;
    const double dy = y - (kHeight - 1) / 2.0;
    const double c = scale * std::cos(angle);
    const double s = scale * std::sin(angle);
    return {(kWidth - 1) / 2.0 + c * dx - s * dy, (kHeight - 1) / 2.0 + s * dx + c * dy};
  }
  Similarity inverse() const { return {-angle, 1 / scale}; }
  cv::Mat render(double sigma) const {
    const SyntheticTexture texture(7);
    const Similarity back = inverse();
    return render_image(
        kWidth, kHeight,
        [&](double x, double y) {
          const cv::Point2d p = back(x, y);
          return texture(p.x, p.y);
        },
        sigma, 99);
  }
};

struct MatchQuality {
  int visible = 0;  ///< keypoints whose point is well inside the second image
  int matched = 0;  ///< mutual nearest neighbours below 50 bits, of these
  int correct = 0;  ///< within 3 px at the keypoint's scale
};

int nearest(const Descriptor& wanted, const Features& among) {
  int best = -1;
  int least = 257;
  for (std::size_t j = 0; j < among.size(); ++j) {
    const int distance = hamming_distance(wanted, among.descriptors[j]);
    if (distance < least) {
      least = distance;
      best = static_cast<int>(j);
    }
  }
  return least < 50 ? best : -1;
}

MatchQuality match(const Features& a, const Features& b, const Similarity& warp,
                   const OrbExtractor& extractor) {
  MatchQuality quality;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const cv::Point2d truth = warp(a.keypoints[i].x, a.keypoints[i].y);
    if (!cv::Rect2d(40, 40, kWidth - 80, kHeight - 80).contains(truth)) continue;
    ++quality.visible;
    const int j = nearest(a.descriptors[i], b);
    if (j < 0) continue;
    const auto other = static_cast<std::size_t>(j);
    if (nearest(b.descriptors[other], a) != static_cast<int>(i)) continue;
    ++quality.matched;
    const double error = std::hypot(b.keypoints[other].x - truth.x, b.keypoints[other].y - truth.y);
    if (error < 3 * extractor.scale_of(a.keypoints[i].level)) ++quality.correct;
  }
  return quality;
}

bool same(const Features& a, const Features& b) {
  return a.descriptors == b.descriptors &&
         std::equal(a.keypoints.begin(), a.keypoints.end(), b.keypoints.begin(), b.keypoints.end(),
                    [](const Keypoint& p, const Keypoint& q) {
                      return p.x == q.x && p.y == q.y && p.angle == q.angle &&
                             p.response == q.response && p.level == q.level;
                    });
}

TEST(OrbExtractor, GivesNearlyTheWantedFeaturesAtEveryLevel) {
  const Features features = OrbExtractor(small_config()).extract(textured()).features;
  EXPECT_EQ(features.keypoints.size(), features.descriptors.size());
  EXPECT_LE(features.size(), 600U);
  EXPECT_GE(features.size(), 540U);
  for (int level = 0; level < 8; ++level) {
    EXPECT_TRUE(std::any_of(features.keypoints.begin(), features.keypoints.end(),
                            [&](const Keypoint& k) { return k.level == level; }))
        << "level " << level;
  }
}

TEST(OrbExtractor, CoversTheImageEvenly) {
  const Features features = OrbExtractor(small_config()).extract(textured()).features;
  // 6 x 4 cells inside the border share 600 features: 25 each on average, none under a third.
  std::vector<int> cells(24, 0);
  for (const Keypoint& k : features.keypoints) {
    const int column = static_cast<int>((k.x - 19) / (kWidth - 38) * 6);
    const int row = static_cast<int>((k.y - 19) / (kHeight - 38) * 4);
    ++cells[static_cast<std::size_t>(row * 6 + column)];
  }
  EXPECT_GT(*std::min_element(cells.begin(), cells.end()), 8);
}

TEST(OrbExtractor, KeepsToTheEdgeAtEveryLevel) {
  const OrbExtractor extractor(small_config());
  for (const Keypoint& k : extractor.extract(textured()).features.keypoints) {
    // 19 px of its level, less the half pixel by which a refined corner may move.
    const double margin = 18.4 * extractor.scale_of(k.level);
    EXPECT_GE(k.x, margin);
    EXPECT_GE(k.y, margin);
    EXPECT_LE(k.x, kWidth - 1 - margin + extractor.scale_of(k.level));
    EXPECT_LE(k.y, kHeight - 1 - margin + extractor.scale_of(k.level));
  }
}

TEST(OrbExtractor, IsTheSameEveryTimeAndOnEveryThread) {
  const OrbExtractor extractor(small_config());
  const cv::Mat image = textured(2, 5);
  const Features once = extractor.extract(image).features;
  std::vector<Features> others(4);
  std::vector<std::thread> threads;
  for (Features& other : others) {
    threads.emplace_back([&] { other = extractor.extract(image.clone()).features; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Features& other : others) EXPECT_TRUE(same(once, other));
}

TEST(OrbExtractor, DoesNotDependOnTheRowPitch) {
  const OrbExtractor extractor(small_config());
  const cv::Mat image = textured();
  cv::Mat wide(kHeight, kWidth + 37, CV_8UC1, cv::Scalar(0));
  image.copyTo(wide(cv::Rect(0, 0, kWidth, kHeight)));
  EXPECT_TRUE(same(extractor.extract(image).features,
                   extractor.extract(wide(cv::Rect(0, 0, kWidth, kHeight))).features));
}

TEST(OrbExtractor, CoordinatesOfEveryLevelMeanTheSamePlace) {
  // A bright round spot with sigma 9 px at (200.3, 150.6): every level's centroid of it, mapped to
  // level 0 by the pixel-centre convention, is that place. A convention off by half a pixel would
  // show as 0.5 (s - 1), up to 1.3 px.
  const cv::Mat spot = render_image(kWidth, kHeight, [](double x, double y) {
    const double dx = x - 200.3;
    const double dy = y - 150.6;
    return 250 * std::exp(-(dx * dx + dy * dy) / 162);
  });
  const OrbExtractor extractor(small_config());
  const Extraction extraction = extractor.extract(spot);
  ASSERT_EQ(extraction.pyramid.size(), 8U);
  for (int level = 0; level < 8; ++level) {
    const cv::Mat& image = extraction.pyramid[static_cast<std::size_t>(level)];
    double sum = 0;
    double sum_x = 0;
    double sum_y = 0;
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const double grey = image.at<std::uint8_t>(y, x);
        sum += grey;
        sum_x += grey * x;
        sum_y += grey * y;
      }
    }
    const double scale = extractor.scale_of(level);
    EXPECT_NEAR((sum_x / sum + 0.5) * scale - 0.5, 200.3, 0.05) << "level " << level;
    EXPECT_NEAR((sum_y / sum + 0.5) * scale - 0.5, 150.6, 0.05) << "level " << level;
  }
}

TEST(OrbExtractor, AnglesTurnWithTheImage) {
  const OrbExtractor extractor(small_config());
  const Features upright = extractor.extract(textured()).features;
  const Similarity quarter{std::numbers::pi / 2, 1};
  const Features turned = extractor.extract(quarter.render(0)).features;
  int pairs = 0;
  int agree = 0;
  for (const Keypoint& a : upright.keypoints) {
    const cv::Point2d at = quarter(a.x, a.y);
    for (const Keypoint& b : turned.keypoints) {
      if (a.level != b.level || std::hypot(b.x - at.x, b.y - at.y) > 0.7) continue;
      ++pairs;
      const double difference =
          std::remainder(b.angle - a.angle - std::numbers::pi / 2, 2 * std::numbers::pi);
      if (std::abs(difference) < 0.1) ++agree;
    }
  }
  ASSERT_GT(pairs, 50);
  EXPECT_GT(agree, pairs * 9 / 10);
}

/// Image 2 is image 1 rotated and scaled, with independent noise of 2 grey levels.
class OrbInvariance : public testing::TestWithParam<Similarity> {};

TEST_P(OrbInvariance, FeaturesMatch) {
  const OrbExtractor extractor(small_config());
  const Features a = extractor.extract(textured(2, 1)).features;
  const Features b = extractor.extract(GetParam().render(2)).features;
  const MatchQuality quality = match(a, b, GetParam(), extractor);
  ASSERT_GT(quality.visible, 100);
  // A third of the visible keypoints are matched, and four in five matches are correct by the
  // nearest descriptor only: half of the outliers of two in five that motion estimation tolerates.
  EXPECT_GT(quality.matched, quality.visible / 3);
  EXPECT_GT(quality.correct, quality.matched * 4 / 5);
}

// Scales up to one level of the pyramid in either direction: matching never compares features
// farther apart.
INSTANTIATE_TEST_SUITE_P(Warps, OrbInvariance,
                         testing::Values(Similarity{0, 1}, Similarity{0.35, 1}, Similarity{1.6, 1},
                                         Similarity{3.0, 1}, Similarity{0, 1.2},
                                         Similarity{0, 0.84}, Similarity{-0.8, 1.2}));

TEST(OrbExtractor, BlankAndTinyImagesHaveNoFeatures) {
  const OrbExtractor extractor(small_config());
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(38, 38), cv::Size(20, 400),
                              cv::Size(1, 1), cv::Size(7, 7), cv::Size(2, 900)}) {
    EXPECT_EQ(extractor.extract(cv::Mat(size, CV_8UC1, cv::Scalar(77))).features.size(), 0U);
  }
}

TEST(OrbExtractor, RefusesOtherImages) {
  const OrbExtractor extractor(small_config());
  EXPECT_THROW(extractor.extract(cv::Mat(100, 100, CV_8UC3, cv::Scalar())), Error);
  EXPECT_THROW(extractor.extract(cv::Mat(100, 100, CV_32FC1, cv::Scalar(0))), Error);
  EXPECT_THROW(extractor.extract(cv::Mat()), Error);
}

}  // namespace
}  // namespace vinebench::slam
