// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/patch_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/support/slanted_plane.h"

namespace vinebench::slam {
namespace {

class PatchFollowerTest : public testing::Test, protected test::SlantedPlane {
 protected:
  PatchFollowerTest() : all_(places.size()) {
    std::iota(all_.begin(), all_.end(), 0);
    // Seen from the keyframe: the direction to each.
    for (const int id : all_) map.landmark(id).normal = map.landmark(id).position.normalized();
  }

  Eigen::Vector3d in_camera(int landmark) const {
    return pose_.inverse() * map.landmark(landmark).position;
  }

  const Pose pose_{exp_so3({0.01, -0.02, 0.02}), {0.03, -0.01, 0.08}};
  std::vector<int> all_;
  Associations associations_ = Associations(1);
  FollowSettings settings_;
};

TEST_F(PatchFollowerTest, FindsLandmarksInBothCameras) {
  const auto frame = stereo_image(pose_);
  // The pose is known to about a pixel.
  const Pose guess = pose_ * Pose{exp_so3({0.002, -0.002, 0}), {0.001, 0, 0}};
  follow_patches(map, all_, guess, rig, settings_, *frame, associations_);
  const StereoView& view = frame->views[0];
  const std::size_t n = view.features.size();
  EXPECT_GT(n, places.size() / 2);  // others leave the image or have too little texture
  ASSERT_EQ(associations_[0].size(), n);
  ASSERT_EQ(view.features.descriptors.size(), n);
  ASSERT_EQ(view.stereo.size(), n);
  EXPECT_EQ(view.followed, n);
  EXPECT_EQ(view.detected(), 0u);
  double pixel_squares = 0;
  double disparity_squares = 0;
  int with_depth = 0;
  for (std::size_t f = 0; f < n; ++f) {
    const Eigen::Vector3d p = in_camera(associations_[0][f]);
    const Keypoint& keypoint = view.features.keypoints[f];
    pixel_squares += (Eigen::Vector2d(keypoint.x, keypoint.y) - lens().project(p)).squaredNorm();
    EXPECT_TRUE(view.is_placed(f));
    if (view.stereo[f].depth <= 0) continue;
    ++with_depth;
    const double disparity = static_cast<double>(keypoint.x - view.stereo[f].x_right);
    disparity_squares += std::pow(disparity - lens().fx * kBaseline / p.z(), 2);
  }
  // Px; noise and interpolation leave less than a tenth on level 0, and half of them are on level
  // 2, whose pixels are 1.44 times larger.
  EXPECT_LT(std::sqrt(pixel_squares / static_cast<double>(n)), 0.15);
  EXPECT_GT(with_depth, static_cast<int>(n) * 2 / 3);
  EXPECT_LT(std::sqrt(disparity_squares / with_depth), 0.3);
}

TEST_F(PatchFollowerTest, LeavesWhatIsTiedAndWhatIsNotAskedFor) {
  const auto frame = stereo_image(pose_);
  const Eigen::Vector2d pixel = lens().project(in_camera(0));
  add_feature(*frame, pixel, 0);
  add_feature(*frame, pixel, 0);
  frame->views[0].placed.assign(2, 0);
  associations_[0] = {0, -1};
  std::vector<int> asked(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(all_.size() / 2));
  map.remove_landmark(2);
  follow_patches(map, asked, pose_, rig, settings_, *frame, associations_);
  ASSERT_GT(associations_[0].size(), 4u);
  EXPECT_EQ(associations_[0][0], 0);
  EXPECT_EQ(associations_[0][1], -1);  // a spurious corner remains without landmark
  EXPECT_EQ(frame->views[0].detected(), 2u);
  EXPECT_FALSE(frame->views[0].is_placed(0));
  std::vector<int> found(associations_[0].begin() + 2, associations_[0].end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());  // unique
  for (const int id : found) {
    EXPECT_NE(id, 0);
    EXPECT_NE(id, 2);
    EXPECT_LT(id, static_cast<int>(asked.size()));
  }
}

TEST_F(PatchFollowerTest, FindsNothingOnAnotherSurface) {
  texture = 99;
  const auto frame = stereo_image(pose_);
  follow_patches(map, all_, pose_, rig, settings_, *frame, associations_);
  EXPECT_LE(associations_[0].size(), places.size() / 20);  // by chance
}

TEST_F(PatchFollowerTest, LooksOnlyForWhatIsSeenFromAboutThatSide) {
  // As if each landmark had been seen from 70 degrees further around; 60 are allowed.
  const Pose around{exp_so3({0, 70 * std::numbers::pi / 180, 0}), Eigen::Vector3d::Zero()};
  for (const int id : all_) {
    map.landmark(id).normal = around.rotation * map.landmark(id).position.normalized();
  }
  const auto frame = stereo_image(Pose{});
  follow_patches(map, all_, Pose{}, rig, settings_, *frame, associations_);
  EXPECT_TRUE(associations_[0].empty());
}

TEST_F(PatchFollowerTest, SpreadsAsManyAsAreAllowed) {
  // The image has 7 x 6 cells of 48 px; at most one landmark in each.
  settings_.refinement.follow = 42;
  const auto frame = stereo_image(pose_);
  follow_patches(map, all_, pose_, rig, settings_, *frame, associations_);
  ASSERT_GT(associations_[0].size(), 5u);
  std::vector<int> per_cell(42, 0);
  for (const int id : associations_[0]) {
    const Eigen::Vector2d pixel = lens().project(in_camera(id));
    ++per_cell[static_cast<std::size_t>(static_cast<int>(pixel.y()) / 48 * 7 +
                                        static_cast<int>(pixel.x()) / 48)];
  }
  EXPECT_EQ(*std::max_element(per_cell.begin(), per_cell.end()), 1);
}

TEST_F(PatchFollowerTest, CanBeSwitchedOffAndNeedsImages) {
  const auto frame = stereo_image(pose_);
  settings_.refinement.follow = 0;
  follow_patches(map, all_, pose_, rig, settings_, *frame, associations_);
  settings_.refinement.follow = 1200;
  settings_.refinement.enabled = false;
  follow_patches(map, all_, pose_, rig, settings_, *frame, associations_);
  settings_.refinement.enabled = true;
  frame->pyramids.clear();
  follow_patches(map, all_, pose_, rig, settings_, *frame, associations_);
  EXPECT_TRUE(associations_[0].empty());
  EXPECT_TRUE(frame->views[0].features.keypoints.empty());
}

TEST_F(PatchFollowerTest, WithoutTheRightCameraThereIsNoDepth) {
  const auto frame = image(pose_);
  frame->right_pyramids.resize(1);
  follow_patches(map, all_, pose_, rig, settings_, *frame, associations_);
  ASSERT_GT(associations_[0].size(), 5u);
  for (const StereoMatch& match : frame->views[0].stereo) EXPECT_LE(match.depth, 0);
}

}  // namespace
}  // namespace vinebench::slam
