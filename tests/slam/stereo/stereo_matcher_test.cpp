// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/stereo_matcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/util/error.h"
#include "tests/support/dirty_lens.h"
#include "tests/support/synthetic_plane.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticPlane;
using test::SyntheticTexture;
using test::through_dirt;

constexpr double kBaseline = 0.12;             // m
constexpr double kFocal = 263.2786;            // px
constexpr double kReach = kFocal * kBaseline;  // px m: disparity times depth
constexpr double kNoise = 1.5;                 // grey levels

PinholeCamera lens(int width, int height) {
  return {width, height, kFocal, kFocal, (width - 1) / 2.0, (height - 1) / 2.0, {}};
}

struct Matched {
  Extraction left;
  std::vector<StereoMatch> matches;
};

Matched match(const cv::Mat& left, const cv::Mat& right, const StereoConfig& config = {}) {
  const OrbExtractor extractor(OrbConfig{});
  Matched result{extractor.extract(left), {}};
  result.matches = match_stereo(result.left, extractor.extract(right), lens(left.cols, left.rows),
                                kBaseline, extractor, config);
  return result;
}

struct Quality {
  int visible = 0;  ///< keypoints whose window lies in the right image too
  int matched = 0;  ///< of these
  int right = 0;    ///< within a pixel of their level, of these
  double rms = 0;   ///< px, of the right ones on level 0
};

template <class Disparity>
Quality judge(const Matched& matched, const Disparity& disparity) {
  Quality quality;
  int on_level_0 = 0;
  for (std::size_t i = 0; i < matched.matches.size(); ++i) {
    const Keypoint& seen = matched.left.features.keypoints[i];
    const double truth = disparity(seen.x, seen.y);
    const double scale = std::pow(1.2, seen.level);
    if (seen.x - truth < 10 * scale) continue;
    ++quality.visible;
    if (matched.matches[i].x_right < 0) continue;
    ++quality.matched;
    const double error = static_cast<double>(seen.x - matched.matches[i].x_right) - truth;
    if (std::abs(error) > scale) continue;
    ++quality.right;
    if (seen.level > 0) continue;
    ++on_level_0;
    quality.rms += error * error;
  }
  quality.rms = std::sqrt(quality.rms / std::max(1, on_level_0));
  return quality;
}

Quality judge(const SyntheticPlane& plane, const StereoConfig& config = {}) {
  return judge(match(plane.left(kNoise), plane.right(kNoise), config),
               [&](double x, double y) { return plane.disparity(x, y); });
}

class StereoPlaneTest : public testing::TestWithParam<SyntheticPlane> {};

TEST_P(StereoPlaneTest, KeypointsAreMatchedAndRight) {
  const Quality quality = judge(GetParam());
  ASSERT_GT(quality.visible, 200);
  // A surface visible in both cameras: almost all of it.
  EXPECT_GT(quality.matched, quality.visible * 95 / 100);
  EXPECT_GT(quality.right, quality.matched * 99 / 100);
  EXPECT_LT(quality.rms, 0.06);
}

// From 31 m to 0.16 m in front of the cameras; planes slanted about the vertical and the horizontal
// axis.
INSTANTIATE_TEST_SUITE_P(Planes, StereoPlaneTest,
                         testing::Values(SyntheticPlane{1.3}, SyntheticPlane{6.0},
                                         SyntheticPlane{23.4}, SyntheticPlane{90.5},
                                         SyntheticPlane{199.7}, SyntheticPlane{40, 0.08},
                                         SyntheticPlane{40, -0.08}, SyntheticPlane{40, 0, 0.25}));

TEST(StereoMatcherTest, DepthIsFocalLengthTimesBaselineByDisparity) {
  SyntheticPlane plane{12};
  const Matched matched = match(plane.left(kNoise), plane.right(kNoise));
  int with_depth = 0;
  for (std::size_t i = 0; i < matched.matches.size(); ++i) {
    const StereoMatch& m = matched.matches[i];
    if (m.depth < 0) continue;
    ++with_depth;
    const double disparity = static_cast<double>(matched.left.features.keypoints[i].x - m.x_right);
    EXPECT_NEAR(m.depth, kReach / disparity, 1e-3);  // m; floats of 500 px are good to 3e-5 px
  }
  EXPECT_GT(with_depth, 200);
}

TEST(StereoMatcherTest, BeyondFortyBaselinesThereIsAMatchButNoDepth) {
  // 40 baselines are 4.8 m: 31.59 / 4.8 = 6.58 px.
  for (const auto& [disparity, near] : {std::pair{5.8, false}, std::pair{7.4, true}}) {
    const SyntheticPlane plane{disparity};
    const Matched matched = match(plane.left(kNoise), plane.right(kNoise));
    int found = 0;
    int with_depth = 0;
    for (const StereoMatch& m : matched.matches) {
      found += m.x_right >= 0;
      with_depth += m.depth > 0;
    }
    EXPECT_GT(found, 200);
    EXPECT_GE(with_depth, near ? found * 98 / 100 : 0);
    EXPECT_LE(with_depth, near ? found : found * 2 / 100);
  }
}

TEST(StereoMatcherTest, NothingIsNearerThanTheNearestDepth) {
  StereoConfig config;
  config.min_depth = 0.8;  // 39.5 px
  const Quality beyond = judge(SyntheticPlane{36}, config);
  EXPECT_GT(beyond.right, beyond.visible * 85 / 100);
  // The last step, the alignment, may move by 5 px of the topmost level, 18 px.
  const Quality before = judge(SyntheticPlane{65}, config);
  EXPECT_EQ(before.right, 0);
  // The texture does not repeat: few windows have a duplicate by chance.
  EXPECT_LT(before.matched, before.visible * 3 / 100);
}

StereoConfig looser_config() {
  StereoConfig config;
  config.max_residual = config.dirty_residual;
  return config;
}

TEST(StereoMatcherTest, DirtExplainsWindowsThatDifferALot) {
  const SyntheticPlane plane{23.4};
  const cv::Mat left = plane.left(kNoise);
  const cv::Mat right = through_dirt(plane.right(kNoise));
  const Matched strict = match(left, right);
  const Matched looser = match(left, right, looser_config());
  EXPECT_TRUE(is_dirty(strict.matches, looser.matches, {}));
  const Quality quality = judge(looser, [&](double x, double y) { return plane.disparity(x, y); });
  EXPECT_GT(quality.matched, quality.visible / 2);
  // By chance one feature in 25 matches.
  EXPECT_GT(quality.right, quality.matched * 96 / 100);
}

TEST(StereoMatcherTest, DirtIsNoExplanationWhereHalfOfTheLensIsClean) {
  const SyntheticPlane plane{23.4};
  const cv::Mat left = plane.left(kNoise);
  const cv::Mat right = through_dirt(plane.right(kNoise), left.cols / 2);
  const Matched strict = match(left, right);
  const Matched looser = match(left, right, looser_config());
  StereoConfig config;
  config.few = 1000;
  // Too few agree and enough are found: the shares alone decide.
  ASSERT_LT(count_found(strict.matches), 1000u);
  ASSERT_GT(count_found(looser.matches), 500u);
  EXPECT_FALSE(is_dirty(strict.matches, looser.matches, config));
}

TEST(StereoMatcherTest, NorWhereTheEyesSeeSomethingElse) {
  SyntheticPlane other{10};
  other.texture = 12;
  const cv::Mat left = SyntheticPlane{10}.left(kNoise);
  const cv::Mat right = other.right(kNoise);
  EXPECT_FALSE(
      is_dirty(match(left, right).matches, match(left, right, looser_config()).matches, {}));
}

TEST(StereoMatcherTest, RepeatedPatternsAreRefused) {
  // Posts every 30 px: the true disparity, 8 px, is as good as 38, 68, ... On levels 0 and 1 these
  // are whole pixels, 30 and 25, and the rivals are equal; on others they fall between pixels.
  const SyntheticTexture texture(3);
  const auto fence = [&](double x, double y) { return texture(x - 30 * std::floor(x / 30), y); };
  const cv::Mat left = render_image(480, 200, fence, kNoise, 1);
  const cv::Mat right = render_image(
      480, 200, [&](double x, double y) { return fence(x + 8, y); }, kNoise, 2);
  const Matched matched = match(left, right);
  int candidates = 0;
  int taken = 0;
  for (std::size_t i = 0; i < matched.matches.size(); ++i) {
    const Keypoint& seen = matched.left.features.keypoints[i];
    // Too near the edge there is one of them only.
    if (seen.level > 1 || seen.x < 80) continue;
    ++candidates;
    taken += matched.matches[i].x_right >= 0;
  }
  ASSERT_GT(candidates, 200);
  EXPECT_LT(taken, candidates * 2 / 100);
}

TEST(StereoMatcherTest, ImagesThatShareNothingAreNotMatched) {
  SyntheticPlane other{10};
  other.texture = 12;
  const Matched matched = match(SyntheticPlane{10}.left(kNoise), other.right(kNoise));
  int taken = 0;
  for (const StereoMatch& m : matched.matches) taken += m.x_right >= 0;
  EXPECT_LT(taken, static_cast<int>(matched.matches.size()) * 2 / 100);
}

/// Vertical stems, 14 px wide and 90 px apart, in front of a textured background.
struct Stems {
  static constexpr double kStem = 40;  ///< px of disparity
  static constexpr double kBackground = 12;
  static bool on_stem(double x) { return x - 90 * std::floor(x / 90) < 14; }
  static double left(double x, double y) {
    return on_stem(x) ? SyntheticTexture(5)(x, y) : SyntheticTexture(11)(x, y);
  }
  static double right(double x, double y) {
    return on_stem(x + kStem) ? SyntheticTexture(5)(x + kStem, y)
                              : SyntheticTexture(11)(x + kBackground, y);
  }
};

TEST(StereoMatcherTest, AWindowAcrossAStemIsRefusedOrRight) {
  const Matched matched = match(render_image(480, 200, Stems::left, kNoise, 1),
                                render_image(480, 200, Stems::right, kNoise, 2));
  int near = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < matched.matches.size(); ++i) {
    const Keypoint& seen = matched.left.features.keypoints[i];
    const double phase = seen.x - 90 * std::floor(seen.x / 90);
    if (seen.level > 0 || seen.x < 60 || (phase > 22 && phase < 82)) continue;
    ++near;
    if (matched.matches[i].x_right < 0) continue;
    const double disparity = static_cast<double>(seen.x - matched.matches[i].x_right);
    // The edge itself belongs to the stem, a pixel to either side of it.
    const bool may_be_stem = phase < 15.5 || phase > 88.5;
    const bool may_be_background = phase > 12.5 || phase < 1.5;
    const bool right = (may_be_stem && std::abs(disparity - Stems::kStem) < 1) ||
                       (may_be_background && std::abs(disparity - Stems::kBackground) < 1);
    wrong += !right;
  }
  ASSERT_GT(near, 40);
  EXPECT_LE(wrong, near * 5 / 100);
}

TEST(StereoMatcherTest, ImpossiblePairsAreErrors) {
  const OrbExtractor extractor(OrbConfig{});
  const cv::Mat image = SyntheticPlane{}.left(0);
  const Extraction left = extractor.extract(image);
  const Extraction right{{}, extractor.pyramid(image)};
  const PinholeCamera camera = lens(image.cols, image.rows);
  EXPECT_THAT([&] { match_stereo(left, right, camera, 0, extractor, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("expected a baseline above 0 m")));
  const Extraction smaller{{}, extractor.pyramid(image.colRange(0, 400).clone())};
  EXPECT_THAT([&] { match_stereo(left, smaller, camera, kBaseline, extractor, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("of the same size")));
}

}  // namespace
}  // namespace vinebench::slam
