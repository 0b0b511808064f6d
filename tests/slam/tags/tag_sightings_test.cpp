// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_sightings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::slam {
namespace {

/// One camera that looks along the body's x axis from 0.2 m ahead, with a bent lens.
TagCameras bent_camera() {
  RigCamera camera;
  camera.model = {640, 480, 400, 400, 319.5, 239.5, {-0.1, 0.01, 0, 0}};
  camera.T_body_cam = Rig::mount({0.2, 0, 0.5}, {0, 0, 0});
  return TagCameras({camera});
}

TEST(TagSightingsTest, CornersAreTheSquaresInTheTagsOwnOrder) {
  // AprilTag's order: lower left first, then counter-clockwise as printed; y down.
  const auto corners = tag_corners(0.2);
  EXPECT_EQ(corners[0], Eigen::Vector3d(-0.1, 0.1, 0));
  EXPECT_EQ(corners[1], Eigen::Vector3d(0.1, 0.1, 0));
  EXPECT_EQ(corners[2], Eigen::Vector3d(0.1, -0.1, 0));
  EXPECT_EQ(corners[3], Eigen::Vector3d(-0.1, -0.1, 0));
}

TEST(TagSightingsTest, NoiseAndSystematicErrorAddInSquares) {
  TagSighting sighting;
  sighting.corner_sigma = 0.3;
  EXPECT_NEAR(corner_sigma(sighting, 0.4), 0.5, 1e-15);  // 3, 4, 5
}

TEST(TagSightingsTest, AnIdealCornerIsWhereAPinholeWouldSeeIt) {
  const TagCameras cameras = bent_camera();
  const Eigen::Vector3d p_cam(0.3, -0.2, 1);
  TagSighting sighting;
  sighting.corners.fill(cameras.cameras[0].model.project(p_cam));
  const Eigen::Vector2d ideal = ideal_corner(sighting, 2, cameras);
  // 319.5 + 400 * 0.3, 239.5 - 400 * 0.2; undistortion iterates to below 1e-6 px.
  EXPECT_NEAR(ideal.x(), 439.5, 1e-6);
  EXPECT_NEAR(ideal.y(), 159.5, 1e-6);
}

TEST(TagSightingsTest, ATagAheadOfTheCameraIsAheadOfTheBody) {
  TagSighting sighting;
  sighting.T_cam_tag.translation = {0, 0, 2};
  // 0.2 m to the camera and 2 m on; at the camera's height.
  const Eigen::Vector3d p_body = T_body_tag(sighting, bent_camera()).translation;
  EXPECT_LT((p_body - Eigen::Vector3d(2.2, 0, 0.5)).norm(), 1e-12);
}

/// What the camera sees of a tag of 0.2 m that stands in the map.
TagSighting seen_from(const Pose& T_map_body, const TagCameras& cameras) {
  const Pose T_map_tag{exp_so3({0.1, 1.7, 0.2}), {2, 0.3, 0.6}};
  const RigCamera& camera = cameras.cameras[0];
  TagSighting sighting;
  sighting.T_cam_tag = (T_map_body * camera.T_body_cam).inverse() * T_map_tag;
  const auto corners = tag_corners(0.2);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sighting.corners[i] = camera.model.project(sighting.T_cam_tag * corners[i]);
  }
  return sighting;
}

TEST(TagSightingsTest, ALateImagesTagIsBroughtToTheFramesStamp) {
  const TagCameras cameras = bent_camera();
  Vector6d velocity;
  velocity << 1, 0.1, 0, 0, 0, 0.4;
  TagSighting sighting = seen_from(step_of(velocity * 0.02), cameras);
  const TagSighting now = seen_from(Pose{}, cameras);
  ASSERT_GT((sighting.corners[0] - now.corners[0]).norm(), 1);  // px
  const TagSighting then = sighting;
  bring_to_stamp(velocity, cameras, sighting);
  EXPECT_EQ(sighting.corners, then.corners);  // nobody said that it was late
  sighting.late = 0.02;
  bring_to_stamp(velocity, cameras, sighting);
  EXPECT_LT((sighting.T_cam_tag.translation - now.T_cam_tag.translation).norm(), 1e-12);
  EXPECT_LT(angle_of(sighting.T_cam_tag.rotation.conjugate() * now.T_cam_tag.rotation), 1e-7);
  for (std::size_t i = 0; i < now.corners.size(); ++i) {
    // Undistortion iterates to below 1e-6 px.
    EXPECT_LT((sighting.corners[i] - now.corners[i]).norm(), 1e-5) << i;
  }
  const TagSighting once = sighting;
  bring_to_stamp(velocity, cameras, sighting);
  EXPECT_EQ(sighting.corners, once.corners);
}

}  // namespace
}  // namespace vinebench::slam
