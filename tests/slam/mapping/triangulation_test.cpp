// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/mapping/triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;

constexpr EpipolarSearch kSearch{.max_hamming = 50};

TEST(TriangulationTest, RaysMeetWhereTheyCross) {
  const Eigen::Vector3d point(0.3, -0.2, 2.0);
  const Eigen::Vector3d a(0, 0, 0);
  const Eigen::Vector3d b(0.4, 0.1, -0.1);
  const auto met = intersect_rays(a, (point - a).normalized(), b, (point - b).normalized());
  ASSERT_TRUE(met);
  EXPECT_LT((*met - point).norm(), 1e-13);
}

TEST(TriangulationTest, SkewRaysMeetHalfWay) {
  // Along z from (0, 0, 0) and along x at z = 2, 0.1 above it.
  const auto met = intersect_rays({0, 0, 0}, {0, 0, 1}, {-1, 0.1, 2}, {1, 0, 0});
  ASSERT_TRUE(met);
  EXPECT_LT((*met - Eigen::Vector3d(0, 0.05, 2)).norm(), 1e-14);
}

TEST(TriangulationTest, NearlyParallelRaysAndRaysThatPartAreRefused) {
  const auto meet = [](double degrees) {
    const double angle = degrees * 3.14159265358979 / 180;
    return intersect_rays({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-std::sin(angle), 0, std::cos(angle)});
  };
  EXPECT_FALSE(meet(0));
  EXPECT_FALSE(meet(0.9));
  EXPECT_TRUE(meet(1.1));
  EXPECT_FALSE(meet(-5));  // they meet behind both cameras
  // In front of the first, behind the second.
  EXPECT_FALSE(intersect_rays({0, 0, 0}, {0, 0, 1}, {-1, 0, 2}, {-1, 0, 0}));
}

/// The frame without its stereo matches.
std::shared_ptr<const FrameFeatures> without_pair(const FrameFeatures& frame) {
  auto copy = std::make_shared<FrameFeatures>(frame);
  for (StereoView& view : copy->views) view.stereo.assign(view.stereo.size(), StereoMatch{});
  return copy;
}

Keyframe keyframe(const SyntheticAisle& aisle, std::int64_t index, const Pose& pose) {
  Keyframe result;
  result.frame = without_pair(*aisle.frame(index, pose));
  result.T_map_body = pose;
  result.landmarks = no_associations(*result.frame);
  return result;
}

TEST(TriangulationTest, EpipolarMatchesAreTheSamePointInItsPlace) {
  const SyntheticAisle aisle(0, 1, 1500);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Keyframe a = keyframe(aisle, 0, Pose{});
  const Keyframe b = keyframe(aisle, 1, Pose{exp_so3({0, 0, 0.05}), {0.25, 0.02, 0}});
  for (int view = 0; view < 2; ++view) {
    const auto matches = match_epipolar(a, b, view, rig, kSearch);
    const auto v = static_cast<std::size_t>(view);
    EXPECT_GT(matches.size(), 40u);
    for (const EpipolarMatch& match : matches) {
      const auto& in_a = a.frame->views[v].features.descriptors;
      const auto& in_b = b.frame->views[v].features.descriptors;
      const int point = aisle.point_of(in_a[static_cast<std::size_t>(match.feature_a)]);
      EXPECT_EQ(aisle.point_of(in_b[static_cast<std::size_t>(match.feature_b)]), point);
      // Pixels are floats, good to 1.5e-5 px or 6e-8 rad; over a degree of parallax at 5 m that is
      // 5 m * 6e-8 / 0.017 = 2e-5 m.
      EXPECT_LT((match.p_map - aisle.point(point)).norm(), 2e-5);
    }
  }
}

TEST(TriangulationTest, WhatHasALandmarkOrADepthIsLeftAlone) {
  const SyntheticAisle aisle(0, 1, 1500);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  Keyframe a = keyframe(aisle, 0, Pose{});
  const Keyframe b = keyframe(aisle, 1, Pose{Eigen::Quaterniond::Identity(), {0.25, 0, 0}});
  const auto matches = match_epipolar(a, b, 0, rig, kSearch);
  ASSERT_GT(matches.size(), 10u);
  const int taken = matches[3].feature_a;
  a.landmarks[0][static_cast<std::size_t>(taken)] = 12;
  const auto fewer = match_epipolar(a, b, 0, rig, kSearch);
  EXPECT_EQ(fewer.size(), matches.size() - 1);
  for (const EpipolarMatch& match : fewer) EXPECT_NE(match.feature_a, taken);
  a.frame = aisle.frame(0, Pose{});  // every feature with its depth
  EXPECT_TRUE(match_epipolar(a, b, 0, rig, kSearch).empty());
}

// Straight ahead all epipolar lines go through the principal point. A feature on the line that
// looks exactly the same elsewhere leaves no choice; at the same corner, found on another level, it
// does.
TEST(TriangulationTest, WhatLooksTheSameElsewhereOnTheLineIsNotMatched) {
  const SyntheticAisle aisle(0, 1, 1500);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Keyframe a = keyframe(aisle, 0, Pose{});
  const Keyframe b = keyframe(aisle, 1, Pose{Eigen::Quaterniond::Identity(), {0.25, 0, 0}});
  const auto matches = match_epipolar(a, b, 0, rig, kSearch);
  ASSERT_GT(matches.size(), 10u);
  const EpipolarMatch& match = matches[3];
  const auto is_found_beside = [&](float stretch) {
    Keyframe crowded = b;
    auto frame = std::make_shared<FrameFeatures>(*b.frame);
    StereoView& view = frame->views[0];
    const auto f = static_cast<std::size_t>(match.feature_b);
    const auto cx = static_cast<float>(rig.left_cameras[0].lens.cx);
    const auto cy = static_cast<float>(rig.left_cameras[0].lens.cy);
    Keypoint twin = view.features.keypoints[f];
    twin.x = cx + stretch * (twin.x - cx);
    twin.y = cy + stretch * (twin.y - cy);
    view.features.keypoints.push_back(twin);
    view.features.descriptors.push_back(view.features.descriptors[f]);
    view.stereo.push_back({});
    crowded.landmarks[0].push_back(-1);
    crowded.frame = frame;
    const auto found = match_epipolar(a, crowded, 0, rig, kSearch);
    return std::ranges::any_of(
        found, [&](const EpipolarMatch& m) { return m.feature_a == match.feature_a; });
  };
  EXPECT_TRUE(is_found_beside(1));
  EXPECT_FALSE(is_found_beside(1.5));
}

TEST(TriangulationTest, NothingIsNearerThanItCanBe) {
  const SyntheticAisle aisle(0, 1, 1500);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Keyframe a = keyframe(aisle, 0, Pose{});
  const Keyframe b = keyframe(aisle, 1, Pose{Eigen::Quaterniond::Identity(), {0.25, 0, 0}});
  const auto nearest_in_b = [&](const EpipolarSearch& search) {
    double nearest = 1e9;
    for (const EpipolarMatch& match : match_epipolar(a, b, 0, rig, search)) {
      const Eigen::Vector3d in_b = b.T_map_body.inverse() * match.p_map;
      nearest = std::min(nearest, (rig.left_cameras[0].T_cam_body * in_b).z());
    }
    return nearest;
  };
  const double nearest = nearest_in_b(kSearch);
  ASSERT_LT(nearest, 4);  // m
  EpipolarSearch farther = kSearch;
  farther.min_depth = nearest + 0.1;
  EXPECT_GE(nearest_in_b(farther), farther.min_depth);
  EXPECT_LT(nearest_in_b(farther), 1e9);
}

TEST(TriangulationTest, FeaturesThatLookDifferentOrWithoutABaselineAreNotMatched) {
  const SyntheticAisle aisle(0, 1, 1500);
  const SyntheticAisle other(0, 2, 1500);  // other points, other descriptors
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Keyframe a = keyframe(aisle, 0, Pose{});
  EXPECT_TRUE(match_epipolar(a,
                             keyframe(other, 1, Pose{Eigen::Quaterniond::Identity(), {0.25, 0, 0}}),
                             0, rig, kSearch)
                  .empty());
  EXPECT_TRUE(match_epipolar(a,
                             keyframe(aisle, 1, Pose{Eigen::Quaterniond::Identity(), {0.01, 0, 0}}),
                             0, rig, kSearch)
                  .empty());
}

}  // namespace
}  // namespace vinebench::slam
