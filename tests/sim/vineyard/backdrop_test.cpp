// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>

#include "sim/vineyard/ground.h"

namespace vinebench::sim {
namespace {

class BackdropTest : public testing::Test {
 protected:
  BackdropTest() { world_.rows = {{{10, 4}, {20, 4}}, {{10, 6}, {20, 6}}}; }

  Scene backdrop(std::uint64_t seed = 1) const {
    Scene scene;
    add_backdrop(scene, world_, lay_out(world_).terrain, seed);
    return scene;
  }
  /// The wall of that name, and where it stands.
  static std::optional<std::pair<Primitive, Pose>> wall(const Scene& scene,
                                                        const std::string& name) {
    for (const Instance& instance : scene.instances) {
      const Model& model = scene.models.at(static_cast<std::size_t>(instance.model));
      if (model.name == name) {
        return std::pair(model.levels.at(0).primitives.at(0), instance.T_world_model);
      }
    }
    return std::nullopt;
  }
  WorldConfig world_;
};

TEST_F(BackdropTest, TheHedgeStandsAroundTheRowsMiddleAtTheGroundsEdge) {
  const auto hedge = wall(backdrop(), "hedge");
  ASSERT_TRUE(hedge);
  EXPECT_LT((hedge->second.translation - Eigen::Vector3d(15, 5, 0)).norm(), 1e-9);
  for (const Vertex& v : hedge->first.vertices) {
    EXPECT_NEAR(v.position.head<2>().norm(), 0.97 * 20, 1e-4);  // of 40 m of ground
    // From a little below the even ground to 9.5 m above its foot.
    EXPECT_TRUE(std::abs(v.position.z() + 0.05f) < 1e-4f ||
                std::abs(v.position.z() - 9.45f) < 1e-4f)
        << v.position.z();
  }
}

TEST_F(BackdropTest, TheHedgeFollowsTheSlope) {
  world_.terrain.slope_percent = 10;  // up to the east
  const auto hedge = wall(backdrop(), "hedge");
  ASSERT_TRUE(hedge);
  for (const Vertex& v : hedge->first.vertices) {
    const float ground = 0.1f * v.position.x() - 0.05f;
    const float above = v.position.z() - ground;
    EXPECT_TRUE(std::abs(above) < 1e-3f || std::abs(above - 9.5f) < 1e-3f) << above;
  }
}

TEST_F(BackdropTest, WallsFaceInwardAndAreClosed) {
  const Scene scene = backdrop();
  for (const char* name : {"hedge", "hills"}) {
    const auto found = wall(scene, name);
    ASSERT_TRUE(found) << name;
    const Primitive& ring = found->first;
    double turned = 0;
    for (std::size_t i = 0; i < ring.indices.size(); i += 3) {
      const Eigen::Vector3f a = ring.vertices.at(ring.indices[i]).position;
      const Eigen::Vector3f b = ring.vertices.at(ring.indices[i + 1]).position;
      const Eigen::Vector3f c = ring.vertices.at(ring.indices[i + 2]).position;
      const Eigen::Vector3f across = (b - a).cross(c - a);
      EXPECT_LT(across.head<2>().dot(a.head<2>()), 0) << name;
      turned += static_cast<double>(across.head<2>().norm()) / 2;
    }
    double height = 0;
    for (std::size_t i = 0; i + 2 < ring.vertices.size(); i += 2) {
      const float low = (ring.vertices[i + 1].position - ring.vertices[i].position).z();
      const float next = (ring.vertices[i + 3].position - ring.vertices[i + 2].position).z();
      height += static_cast<double>(low + next) / 2 *
                static_cast<double>(
                    (ring.vertices[i + 2].position - ring.vertices[i].position).head<2>().norm());
    }
    EXPECT_NEAR(turned, height, 1e-3 * height) << name;  // the area of the whole ring
    EXPECT_LT(
        (ring.vertices.front().position - ring.vertices[ring.vertices.size() - 2].position).norm(),
        1e-3f);
  }
}

TEST_F(BackdropTest, HillsRiseBehindTheHedgeUnlessItHidesThem) {
  const auto hills = wall(backdrop(), "hills");
  ASSERT_TRUE(hills);
  float highest = 0;
  for (const Vertex& v : hills->first.vertices) {
    EXPECT_NEAR(v.position.head<2>().norm(), 80, 1e-3);  // four times the ground's half
    highest = std::max(highest, v.position.z());
  }
  EXPECT_GT(highest, 0.19f * 80);
  EXPECT_LT(highest, (0.19f + 0.03f * 1.9f) * 80);
  world_.ground_size = 310;  // hills stay within 165 m, 1.06 times the hedge's 155 m
  EXPECT_FALSE(wall(backdrop(), "hills"));
  EXPECT_TRUE(wall(backdrop(), "hedge"));
}

TEST_F(BackdropTest, TheSeedShapesTheHills) {
  const auto first = wall(backdrop(), "hills"), again = wall(backdrop(), "hills");
  const auto other = wall(backdrop(2), "hills");
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ(first->first.vertices[1].position, again->first.vertices[1].position);
  EXPECT_NE(first->first.vertices[1].position, other->first.vertices[1].position);
}

}  // namespace
}  // namespace vinebench::sim
