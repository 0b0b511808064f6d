// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/transform_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_bag.h"

namespace vinebench::harness {
namespace {

const double kHalf = std::sqrt(0.5);

RosTransform mount(const std::string& parent, const std::string& child, const RosPose& pose) {
  return test::mount_of(child, pose, parent);
}

TEST(TransformTreeTest, PosesAreChainedUpAndDown) {
  // The arm is a metre ahead of the base and turned to the left by 90 degrees; the camera is two
  // metres ahead on the arm: at (1, 2, 0) of the base. The mast is three metres above the base.
  const TransformTree tree({mount("base", "arm", {{1, 0, 0}, {0, 0, kHalf, kHalf}}),
                            mount("arm", "camera", {{2, 0, 0}, {0, 0, 0, 1}}),
                            mount("base", "mast", {{0, 0, 3}, {0, 0, 0, 1}})});
  const auto T_base_camera = tree.between("base", "camera");
  ASSERT_TRUE(T_base_camera);
  EXPECT_TRUE(T_base_camera->translation.isApprox(Eigen::Vector3d(1, 2, 0), 1e-12));
  const auto T_mast_camera = tree.between("mast", "camera");
  ASSERT_TRUE(T_mast_camera);
  EXPECT_TRUE(T_mast_camera->translation.isApprox(Eigen::Vector3d(1, 2, -3), 1e-12));
  const auto T_camera_base = tree.between("camera", "base");
  ASSERT_TRUE(T_camera_base);
  EXPECT_LT((*T_camera_base * Eigen::Vector3d(1, 2, 0)).norm(), 1e-12);
}

TEST(TransformTreeTest, WhatIsNotConnectedIsNotKnown) {
  const TransformTree tree({mount("base", "arm", {}), mount("other", "part", {})});
  EXPECT_FALSE(tree.between("base", "part"));
  EXPECT_FALSE(tree.between("base", "none"));
  EXPECT_TRUE(tree.between("none", "none"));  // a frame and itself
}

TEST(TransformTreeTest, CirclesEnd) {
  const TransformTree tree({mount("a", "b", {}), mount("b", "a", {})});
  EXPECT_TRUE(tree.between("a", "b"));
  EXPECT_FALSE(tree.between("c", "a"));
}

/// Searching long lines of frames would take the square of their length.
TEST(TransformTreeTest, LinesOfFramesHaveALimit) {
  std::vector<RosTransform> mounts;
  for (int i = 0; i < 300; ++i) {
    mounts.push_back(mount(std::to_string(i), std::to_string(i + 1), {}));
  }
  const TransformTree tree(mounts);
  EXPECT_TRUE(tree.between("0", "200"));
  EXPECT_FALSE(tree.between("0", "300"));
}

TEST(TransformTreeTest, TheLaterMountOfAFrameAndNamesWithASlash) {
  const TransformTree tree({mount("base", "arm", {{1, 0, 0}, {0, 0, 0, 1}}),
                            mount("/base", "/arm", {{2, 0, 0}, {0, 0, 0, 1}})});
  EXPECT_EQ(tree.between("base", "/arm")->translation.x(), 2);
}

/// A mount of ours is the rig's to the bit; one that is nearly of unit length is made so.
TEST(TransformTreeTest, RotationsAreKeptOrNormalised) {
  EXPECT_EQ(pose_of({{0, 0, 0}, {-0.5, 0.5, -0.5, 0.5}}).rotation.x(), -0.5);
  EXPECT_NEAR(pose_of({{0, 0, 0}, {0, 0, 0, 1.001}}).rotation.w(), 1, 1e-15);
}

}  // namespace
}  // namespace vinebench::harness
