// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/patch_projector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/slanted_plane.h"

namespace vinebench::slam {
namespace {

class PatchProjectorTest : public testing::Test, protected test::SlantedPlane {
 protected:
  /// All views at once.
  std::vector<Pose> at(const Pose& pose) const { return {rig.left_cameras.size(), pose}; }

  static Observation seen(std::size_t landmark) { return {0, 0, static_cast<int>(landmark)}; }

  /// RMS error (px) of windows that are searched at their true positions in the image from a pose;
  /// `found` counts those that fit.
  template <class Predict>
  double fit_error(const Pose& pose, const Predict& predict, int& found) const {
    const auto frame = image(pose);
    double squares = 0;
    found = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d pixel = lens().project(pose.inverse() * on_plane(places[i]));
      if (!lens().contains(pixel, 30)) continue;
      const std::optional<PatchView> view = predict(i);
      if (!view) continue;
      const double scale = rig.noise.level_scales[static_cast<std::size_t>(view->level)];
      const Eigen::Vector2d at(to_level(pixel.x(), scale), to_level(pixel.y(), scale));
      const auto fit = fit_patch(
          view->window, frame->pyramids[0][static_cast<std::size_t>(view->level)], at.x(), at.y());
      if (!fit || !RefinementConfig{}.accepts(*fit)) continue;
      ++found;
      squares += (Eigen::Vector2d(fit->x, fit->y) - at).squaredNorm();
    }
    return std::sqrt(squares / std::max(1, found));
  }
};

TEST_F(PatchProjectorTest, FromTheSamePlaceAPatchIsItself) {
  PatchProjector projector(map, at(Pose{}), rig);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto view = projector.on_best_level(seen(i), 0, map.landmark(static_cast<int>(i)));
    ASSERT_TRUE(view) << i;
    EXPECT_EQ(view->level, level_of(places[i])) << i;
    const auto itself =
        warp_patch(*map.keyframe(0).patches[0].find(i), Eigen::Matrix3d::Identity());
    // Grey levels; the depth is a float, which shifts the sampled positions by 1e-5 px.
    for (std::size_t k = 0; k < itself->grey.size(); ++k) {
      EXPECT_NEAR(view->window.grey[k], itself->grey[k], 0.01);
    }
  }
}

TEST_F(PatchProjectorTest, ForetellsWhatAnotherPoseSees) {
  // 0.15 m nearer (of about 1.2 m), sideways, and rotated by 6 degrees about the line of sight.
  const Pose pose{exp_so3({0.02, -0.03, 0.1}), {0.05, -0.03, 0.15}};
  PatchProjector projector(map, at(pose), rig);
  int found = 0;
  const double foretold = fit_error(
      pose,
      [&](std::size_t i) {
        return projector.on_best_level(seen(i), 0, map.landmark(static_cast<int>(i)));
      },
      found);
  EXPECT_GT(found, static_cast<int>(places.size()) / 2);  // others leave, or have little texture
  EXPECT_LT(foretold, 0.1);  // px; noise and interpolation, as in patch_test
  // The unwarped patch fits fewer, or worse.
  int found_plain = 0;
  const double plain = fit_error(
      pose,
      [&](std::size_t i) {
        const auto window =
            warp_patch(*map.keyframe(0).patches[0].find(i), Eigen::Matrix3d::Identity());
        return std::optional(PatchView{level_of(places[i]), *window});
      },
      found_plain);
  EXPECT_TRUE(found_plain < found * 2 / 3 || plain > 2 * foretold)
      << found_plain << " of " << found << ", " << plain << " px of " << foretold;
}

TEST_F(PatchProjectorTest, NearerIsALevelUp) {
  // A fifth larger is one level up, whose pixels are a fifth larger; along the ray of a landmark in
  // the middle of each half, 1 - 1 / 1.2 of the distance to it.
  for (const std::size_t i : {places.size() / 2, places.size() / 2 + 3}) {
    const Landmark& landmark = map.landmark(static_cast<int>(i));
    const Pose nearer{Eigen::Quaterniond::Identity(), (1 - 1 / 1.2) * landmark.position};
    PatchProjector projector(map, at(nearer), rig);
    const auto view = projector.on_best_level(seen(i), 0, landmark);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->level, level_of(places[i]) + 1);
    EXPECT_TRUE(projector.on_level(seen(i), 0, landmark, level_of(places[i])));  // 1.2 is not 1.4
  }
}

TEST_F(PatchProjectorTest, SaysNothingOfWhatItCannotKnow) {
  const Landmark& landmark = map.landmark(0);  // at level 0
  PatchProjector here(map, at(Pose{}), rig);
  ASSERT_TRUE(here.on_level(seen(0), 0, landmark, 0));
  EXPECT_TRUE(here.on_level(seen(0), 0, landmark, 1));
  EXPECT_FALSE(here.on_level(seen(0), 0, landmark, 2));    // 1.44 times smaller: another image
  EXPECT_FALSE(here.on_level({0, 1, 0}, 0, landmark, 0));  // of another view

  map.keyframe(0).patches[0] = PatchList(map.keyframe(0).patches[0].size());
  EXPECT_FALSE(here.on_level(seen(0), 0, landmark, 0));  // cut too near the border
  map.keyframe(0).patches.clear();
  EXPECT_FALSE(here.on_level(seen(1), 0, map.landmark(1), 0));  // a keyframe without images
}

TEST_F(PatchProjectorTest, SaysNothingFromBehind) {
  const Landmark& landmark = map.landmark(0);
  const Pose past{Eigen::Quaterniond::Identity(), 1.5 * landmark.position};
  EXPECT_FALSE(PatchProjector(map, at(past), rig).on_best_level(seen(0), 0, landmark));
}

}  // namespace
}  // namespace vinebench::slam
