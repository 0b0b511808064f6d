// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/gpu_scene.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "core/util/error.h"
#include "core/util/random.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

TEST(DrawOrderTest, IsTheAxisThatTheCameraIsAlong) {
  EXPECT_EQ(draw_order({2, 1, 9}), 0);
  EXPECT_EQ(draw_order({-2, 1, 0}), 1);
  EXPECT_EQ(draw_order({1, 2, 0}), 2);
  EXPECT_EQ(draw_order({-1, -2, 0}), 3);
}

/// Triangles at random places of a square of 1 m.
Primitive scattered(int triangles) {
  const RandomStream random(1, "triangles");
  Primitive part;
  for (int i = 0; i < triangles; ++i) {
    const auto draw = static_cast<std::uint64_t>(2 * i);
    const Eigen::Vector3f at(static_cast<float>(random.uniform(draw)),
                             static_cast<float>(random.uniform(draw + 1)), 0);
    for (const Eigen::Vector3f& offset :
         {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.01f, 0, 0), Eigen::Vector3f(0, 0.01f, 0)}) {
      part.indices.push_back(static_cast<std::uint32_t>(part.vertices.size()));
      part.vertices.push_back({at + offset, Eigen::Vector3f::UnitZ()});
    }
  }
  return part;
}

TEST(SortedIndicesTest, TrianglesTowardsTheCameraComeFirst) {
  const Primitive part = scattered(500);
  const std::vector<std::uint32_t> sorted = sorted_indices(part);
  ASSERT_EQ(sorted.size(), 4 * part.indices.size());
  for (int order = 0; order < kDrawOrders; ++order) {
    const std::size_t first = static_cast<std::size_t>(order) * part.indices.size();
    std::set<std::uint32_t> drawn;
    float nearest = 2;
    for (std::size_t i = 0; i < part.indices.size(); i += 3) {
      const std::uint32_t corner = sorted[first + i];
      EXPECT_EQ(sorted[first + i + 1], corner + 1);  // whole triangles, turned the same way
      EXPECT_EQ(sorted[first + i + 2], corner + 2);
      drawn.insert(corner);
      const float sign = order % 2 == 0 ? 1.0f : -1.0f;
      const float along = sign * part.vertices[corner].position[order / 2];
      // Coarsely: by 24 bins of about 4 cm.
      EXPECT_LT(along, nearest + 0.045f);
      nearest = std::min(nearest, along);
    }
    EXPECT_EQ(drawn.size(), 500u);
  }
}

TEST(SortedIndicesTest, AFewTrianglesStayAsTheyAre) {
  const Primitive part = scattered(31);
  const std::vector<std::uint32_t> sorted = sorted_indices(part);
  for (int order = 0; order < kDrawOrders; ++order) {
    EXPECT_TRUE(std::equal(part.indices.begin(), part.indices.end(),
                           sorted.begin() + order * static_cast<long>(part.indices.size())));
  }
}

TEST(PlaceTest, ABallHoldsTheInstance) {
  GpuModel model;
  model.bounds = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.4f, 0.4f, 0.2f)};
  const Pose T_world_model{exp_so3({0, 0, std::numbers::pi / 2}), {10, 20, 0}};
  const GpuInstance instance = place(3, model, T_world_model, 2);
  EXPECT_EQ(instance.model, 3);
  // The middle (0.2, 0.2, 0.1), twice as far, turned to the left; half of twice the diagonal 0.6.
  EXPECT_LT((instance.centre - Eigen::Vector3d(9.6, 20.4, 0.2)).norm(), 1e-6);
  EXPECT_NEAR(instance.radius, 0.6, 1e-6);
  EXPECT_LT(
      (instance.model_from_world * instance.world_from_model - Eigen::Matrix4d::Identity()).norm(),
      1e-12);
}

class GpuSceneTest : public test::GlTest {
 protected:
  GpuSceneTest() {
    test::add_material(scene_, Label::kGround, Eigen::Vector3f::Ones());
    test::add_material(scene_, Label::kBox, Eigen::Vector3f::Ones());
  }
  Scene scene_;
};

TEST_F(GpuSceneTest, WhatGrowsOnTheGroundOrIsItCastsNoShadow) {
  test::add_model(scene_, test::panel(0, 1, 1));
  test::add_model(scene_, test::panel(1, 1, 1));
  scene_.models.push_back(scene_.models[0]);
  scene_.models[2].levels.push_back(scene_.models[1].levels[0]);  // either in any level
  const GpuScene gpu(gl_, scene_);
  EXPECT_FALSE(gpu.models[0].casts_shadow);
  EXPECT_TRUE(gpu.models[1].casts_shadow);
  EXPECT_TRUE(gpu.models[2].casts_shadow);
}

TEST_F(GpuSceneTest, AModelsBoundsAreOfAllItsLevels) {
  test::add_model(scene_, test::panel(1, 1, 1));
  scene_.models[0].levels[0].until = 5;
  scene_.models[0].levels.push_back({1e9, {test::panel(1, 3, 0.5)}});
  const GpuScene gpu(gl_, scene_);
  EXPECT_EQ(gpu.models[0].bounds.sizes(), Eigen::Vector3f(3, 0, 1));
  ASSERT_EQ(gpu.models[0].levels.size(), 2u);
  EXPECT_EQ(gpu.models[0].levels[0].until, 5);
  EXPECT_EQ(gpu.models[0].levels[1].primitives[0].count, 6);
  EXPECT_EQ(gpu.models[0].levels[1].primitives[0].first_vertex, 4);  // behind the first level's
  EXPECT_FALSE(gpu.models[0].ordered);
}

TEST_F(GpuSceneTest, TheRoversHullHoldsItsFinestVertices) {
  scene_.rover_model = test::add_model(scene_, test::panel(1, 2, 1));
  scene_.models[0].levels.push_back({1e9, {test::panel(1, 9, 9)}});
  const GpuScene gpu(gl_, scene_);
  EXPECT_TRUE(gpu.movers(0, std::nullopt).empty());
  const std::vector<Mover> movers = gpu.movers(0, Pose{});
  ASSERT_EQ(movers.size(), 1u);
  ASSERT_EQ(movers[0].hull->size(), 4u);
  for (const Eigen::Vector3d& corner : *movers[0].hull) {
    EXPECT_LT((corner.cwiseAbs() - Eigen::Vector3d(1, 0, 0.5)).norm(), 1e-6);
  }
}

TEST_F(GpuSceneTest, WiresAreCutIntoPiecesByTheirPlaces) {
  // 3 m from x = 2.5: twelve pieces of 0.25 m, of which those from x = 4 on hang over the next
  // square of 4 m.
  scene_.wires.push_back({{2.5f, 1, 1}, {5.5f, 1, 1}, 0.002f, 1});
  scene_.wires.push_back({{2.5f, 1, 0.5f}, {3.0f, 1, 0.5f}, 0.004f, 1});
  scene_.wires.push_back({{0, 0, 0}, {0, 0, 0.1f}, 0.001f, 0});  // of another material
  const GpuScene gpu(gl_, scene_);
  ASSERT_EQ(gpu.wires.size(), 2u);
  EXPECT_EQ(gpu.wires[0].material, 0);
  EXPECT_EQ(gpu.wires[0].chunks.at(0).count, 6);
  const std::vector<WireChunk>& chunks = gpu.wires[1].chunks;
  ASSERT_EQ(chunks.size(), 2u);
  EXPECT_EQ(chunks[0].count, 6 * (6 + 2));
  EXPECT_EQ(chunks[1].count, 6 * 6);
  EXPECT_EQ(chunks[1].first, chunks[0].count);
  EXPECT_NEAR(chunks[0].thickest, 0.004, 1e-9);
  EXPECT_LT((chunks[1].centre - Eigen::Vector3d(4.75, 1, 1)).norm(), 1e-6);
  EXPECT_NEAR(chunks[1].reach, 0.75 + 0.002, 1e-6);
}

TEST_F(GpuSceneTest, ASceneThatRefersToNothingIsAnError) {
  test::add_instance(scene_, 0, {0, 0, 0});
  EXPECT_THROW(GpuScene(gl_, scene_), Error);
}

}  // namespace
}  // namespace vinebench::sim
