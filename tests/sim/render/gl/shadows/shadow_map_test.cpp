// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/shadow_map.h"

#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

constexpr int kSize = 128;  // pixels a side

/// A board of 1 m x 1 m on edge at the origin, lit from -y: it lies in the plane y = 0. Another one
/// of 4 m x 4 m stands 2 m behind it.
class ShadowMapTest : public test::GlTest {
 protected:
  ShadowMapTest() {
    box_ = test::add_material(scene_, Label::kBox, Eigen::Vector3f::Ones());
    test::add_instance(scene_, test::add_model(scene_, test::panel(box_, 1, 1)), {0, 0, 0});
    test::add_instance(scene_, test::add_model(scene_, test::panel(box_, 4, 4)), {0, 2, 0});
    scene_.light.towards_sun = {0, -1, 0};
  }
  /// Whether the map has something nearer to the sun than a point.
  bool shaded(const Eigen::Vector3d& p_world, int size = kSize) const {
    const GpuScene gpu(gl_, scene_);
    const ShadowMap map(gpu, size);
    const Eigen::Vector3d p = (map.map_from_world() * p_world.homogeneous()).head<3>();
    const cv::Mat depth = depths(map.texture(), size);
    const auto at = [&](double x) { return static_cast<int>(x * size); };
    EXPECT_TRUE((p.array() > 0).all() && (p.array() < 1).all()) << p.transpose();
    return static_cast<double>(depth.at<float>(at(p.y()), at(p.x()))) < p.z();
  }
  Scene scene_;
  int box_ = 0;
};

TEST_F(ShadowMapTest, WhatIsBehindACasterIsShaded) {
  EXPECT_TRUE(shaded({0.4, 1.9, 0.4}));
  EXPECT_TRUE(shaded({-0.4, 0.5, -0.4}));
  EXPECT_FALSE(shaded({0.6, 1.9, 0.4}));  // beside it
  EXPECT_FALSE(shaded({0.4, 1.9, -0.6}));
  EXPECT_FALSE(shaded({0.4, -0.02, 0.4}));  // before it
}

TEST_F(ShadowMapTest, ATexelIsThatShareOfTheWidestSide) {
  const GpuScene gpu(gl_, scene_);
  EXPECT_NEAR(ShadowMap(gpu, kSize).texel(), 4.0 / kSize, 1e-6);
}

TEST_F(ShadowMapTest, ShadowsAreThoseOfInstancesInTheirPlaces) {
  scene_.instances[0].T_world_model.translation.x() = 1;
  scene_.instances[0].scale = 1.4f;
  EXPECT_FALSE(shaded({-0.4, 1.9, 0}));
  EXPECT_TRUE(shaded({1.65, 1.9, 0}));
  EXPECT_FALSE(shaded({1.75, 1.9, 0}));
}

TEST_F(ShadowMapTest, ACutOutShadesWhereItIsOpaque) {
  cv::Mat half(2, 2, CV_8UC4, cv::Scalar::all(255));
  half.col(0).setTo(cv::Scalar(255, 255, 255, 0));
  const int leaf = test::add_material(scene_, Label::kLeaf, Eigen::Vector3f::Ones(), half);
  scene_.models[0].levels[0].primitives[0].material = leaf;
  EXPECT_TRUE(shaded({-0.4, 1.9, 0}));  // its alpha does not count yet
  scene_.materials.back().cutout = true;
  EXPECT_FALSE(shaded({-0.4, 1.9, 0}));
  EXPECT_TRUE(shaded({0.4, 1.9, 0}));
}

TEST_F(ShadowMapTest, WithoutCastersOrPixelsThereIsNoShadow) {
  const GpuScene gpu(gl_, scene_);
  const ShadowMap off(gpu, 0);
  EXPECT_EQ(off.texel(), 0);
  EXPECT_EQ(depths(off.texture(), 1).at<float>(0, 0), 1);
  scene_.materials[0].label = Label::kGround;
  const GpuScene ground(gl_, scene_);
  const ShadowMap none(ground, 4);
  EXPECT_EQ(cv::countNonZero(depths(none.texture(), 4) != 1.0f), 0);
  EXPECT_TRUE(none.map_from_world().isIdentity());
}

TEST_F(ShadowMapTest, ACasterIsDrawnAsCoarseAsItsTexels) {
  // Little is left of the board from 20 m on. A texel of 4 m / 128 is as large as a pixel of
  // kLevelFocalLength at 34 m, one of 4 m / 512 as at 8.6 m.
  scene_.models[0].levels[0].until = 20;
  scene_.models[0].levels.push_back({1e9, {test::panel(box_, 0.1, 0.1)}});
  EXPECT_FALSE(shaded({0.4, 1.9, 0.4}));
  EXPECT_TRUE(shaded({0.4, 1.9, 0.4}, 512));
}

}  // namespace
}  // namespace vinebench::sim
