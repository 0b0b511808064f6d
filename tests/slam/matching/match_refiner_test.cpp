// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/match_refiner.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/slanted_plane.h"

namespace vinebench::slam {
namespace {

class MatchRefinerTest : public testing::Test, protected test::SlantedPlane {};

TEST_F(MatchRefinerTest, MovesMatchesToWhereTheLandmarkIs) {
  const Pose T_map_body{exp_so3({0.01, -0.02, 0}), {0.02, -0.01, 0.1}};
  auto frame = image(T_map_body);
  Associations associations(1);
  std::vector<Eigen::Vector2d> truth;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d pixel = lens().project(T_map_body.inverse() * on_plane(places[i]));
    if (!lens().contains(pixel, 30)) continue;
    const int level = places[i].x() > 160 ? 2 : 0;
    truth.push_back(pixel);
    add_feature(*frame, pixel + std::pow(1.2, level) * Eigen::Vector2d(0.6, -0.5), level);
    associations[0].push_back(static_cast<int>(i));
  }
  const float disparity =
      frame->views[0].features.keypoints[0].x - frame->views[0].stereo[0].x_right;
  refine_matches(map, T_map_body, rig, RefinementConfig{}, *frame, associations);

  int placed = 0;
  double squares = 0;
  for (std::size_t f = 0; f < truth.size(); ++f) {
    if (associations[0][f] < 0) continue;
    ++placed;
    EXPECT_TRUE(frame->views[0].is_placed(f));
    const Keypoint& keypoint = frame->views[0].features.keypoints[f];
    squares += (Eigen::Vector2d(keypoint.x, keypoint.y) - truth[f]).squaredNorm();
  }
  EXPECT_GT(placed, static_cast<int>(truth.size()) * 2 / 3);  // others have too little texture
  // Started 0.8 px off; noise and interpolation leave less than a tenth of a pixel.
  EXPECT_LT(std::sqrt(squares / placed), 0.1);
  // The stereo match has moved too.
  EXPECT_NEAR(frame->views[0].features.keypoints[0].x - frame->views[0].stereo[0].x_right,
              disparity, 1e-4);
}

TEST_F(MatchRefinerTest, UntiesWhatThePatchContradicts) {
  auto frame = image(Pose{});
  Associations associations(1);
  // Every feature is associated with the landmark one row below: same level, different position.
  const auto row = static_cast<std::size_t>(
      std::ranges::count(places, places[0].y(), [](const Eigen::Vector2d& p) { return p.y(); }));
  for (std::size_t i = 0; i + row < places.size(); ++i) {
    add_feature(*frame, places[i], places[i].x() > 160 ? 2 : 0);
    associations[0].push_back(static_cast<int>(i + row));
  }
  refine_matches(map, Pose{}, rig, RefinementConfig{}, *frame, associations);
  const auto kept =
      std::count_if(associations[0].begin(), associations[0].end(), [](int id) { return id >= 0; });
  EXPECT_LE(kept, static_cast<int>(associations[0].size()) / 20);
}

TEST_F(MatchRefinerTest, LeavesAFrameWithoutImagesAlone) {
  auto frame = image(Pose{});
  add_feature(*frame, places[0], 0);
  frame->pyramids.clear();
  Associations associations{{0}};
  refine_matches(map, Pose{}, rig, RefinementConfig{}, *frame, associations);
  EXPECT_EQ(associations[0][0], 0);
  EXPECT_FALSE(frame->views[0].is_placed(0));
}

}  // namespace
}  // namespace vinebench::slam
