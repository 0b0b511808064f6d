// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop_correction.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vinebench {
namespace {

/// Keyframes at x = 0, 1, 2 and 4 m, each with a landmark of its own one metre to its left.
Map straight_map() {
  Map map(1.2);
  for (const double x : {0.0, 1.0, 2.0, 4.0}) {
    auto frame = std::make_shared<FrameFeatures>();
    frame->views.resize(1);
    const int id = map.add_keyframe(frame, {Eigen::Quaterniond::Identity(), {x, 0, 0}}, {{}});
    map.landmarks().emplace_back();
    map.landmarks().back().id = id;
    map.landmarks().back().first_keyframe = id;
    map.landmarks().back().position = {x, 1, 0};
  }
  return map;
}

// The last keyframe moves by (0.3, 0, 0.6): of the 3 m of way since keyframe 1 the one at x = 2 has
// done a third, so it moves by (0.1, 0, 0.2), its landmark with it.
TEST(SpreadCorrectionTest, GrowsWithTheWayAndTakesLandmarksAlong) {
  Map map = straight_map();
  spread_correction(map, 1, 3, {Eigen::Quaterniond::Identity(), {4.3, 0, 0.6}});
  const auto at = [&](int id) { return map.keyframe(id).T_map_body.translation; };
  EXPECT_LT((at(0) - Eigen::Vector3d(0, 0, 0)).norm(), 1e-12);
  EXPECT_LT((at(1) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((at(2) - Eigen::Vector3d(2.1, 0, 0.2)).norm(), 1e-12);
  EXPECT_LT((at(3) - Eigen::Vector3d(4.3, 0, 0.6)).norm(), 1e-12);
  EXPECT_LT((map.landmark(1).position - Eigen::Vector3d(1, 1, 0)).norm(), 1e-12);
  EXPECT_LT((map.landmark(2).position - Eigen::Vector3d(2.1, 1, 0.2)).norm(), 1e-12);
}

// Turned by 90 degrees about its own place, the last keyframe stays there, its landmark swings
// round it; the way before is turned by its share and no farther away.
TEST(SpreadCorrectionTest, TurnsAboutTheLastKeyframe) {
  Map map = straight_map();
  const Eigen::Quaterniond quarter(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  spread_correction(map, 0, 3, {quarter, {4, 0, 0}});
  EXPECT_LT((map.keyframe(3).T_map_body.translation - Eigen::Vector3d(4, 0, 0)).norm(), 1e-12);
  EXPECT_LT((map.landmark(3).position - Eigen::Vector3d(3, 0, 0)).norm(), 1e-12);
  // Half of the way done: 45 degrees about (4, 0), at a distance of 2 m.
  const double s = 2 * std::sqrt(0.5);
  EXPECT_LT((map.keyframe(2).T_map_body.translation - Eigen::Vector3d(4 - s, -s, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace vinebench
