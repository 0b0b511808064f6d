// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/view_export.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// A panel of 0.8 m by 0.6 m of one quad near, of two beyond 6 m (at 1100 px).
class ViewExportTest : public testing::Test {
 protected:
  ViewExportTest() {
    view_.camera = test::small_camera();
    view_.camera.fx = view_.camera.fy = kLevelFocalLength;
    const int material = test::add_material(scene_, Label::kBox, {0.2f, 0.4f, 0.6f});
    Model& model = scene_.models[static_cast<std::size_t>(
        test::add_model(scene_, test::panel(material, 0.8, 0.6)))];
    model.levels[0].until = 6;
    model.levels.push_back(
        {30, {test::panel(material, 0.8, 0.6), test::panel(material, 0.8, 0.6)}});
  }
  /// Turned by a quarter about the vertical: in the plane of x.
  void place(const Eigen::Vector3d& at, float scale = 1) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
    scene_.instances.push_back({0, {turn, at}, scale, 0});
  }
  static std::vector<int> levels(const std::vector<PlacedMesh>& placed) {
    std::vector<int> list;
    for (const PlacedMesh& one : placed) list.push_back(one.level);
    return list;
  }
  Scene scene_;
  ExportedView view_;
};

TEST_F(ViewExportTest, EachAtItsLevelAndWithinReach) {
  for (const double x : {5.0, -5.0, 20.0, 40.0}) place({x, 0, 0});
  EXPECT_EQ(levels(meshes_in_reach(scene_, view_)), (std::vector{0, 0, 1}));
  view_.lod_scale = 4;  // 6 and 30 m become 24 and 120
  EXPECT_EQ(levels(meshes_in_reach(scene_, view_)), (std::vector{0, 0, 0, 1}));
  view_.reach = 10;
  EXPECT_EQ(levels(meshes_in_reach(scene_, view_)), (std::vector{0, 0}));
  scene_.materials[0].terrain = true;  // the ground has no end
  EXPECT_EQ(meshes_in_reach(scene_, view_).size(), 4u);
}

/// One near of twice the size: 1.6 m in y and 1.2 m in z about (5, 1, 0.5); one far about
/// (20, -2, 0). Two and four triangles, and eight of a wire from (1, 0, 1) to (1, 3, 1), 2 mm
/// across; another wire is out of reach.
TEST_F(ViewExportTest, TheFileHasEveryTriangleInItsPlace) {
  place({5, 1, 0.5}, 2);
  place({20, -2, 0});
  scene_.wires.push_back({{1, 0, 1}, {1, 3, 1}, 0.001f, 0});
  scene_.wires.push_back({{100, 0, 1}, {100, 3, 1}, 0.001f, 0});
  std::vector<PlacedMesh> placed = meshes_in_reach(scene_, view_);
  add_wires(scene_, view_, placed);
  const test::TestFolder folder;
  Asset back = load_asset(folder.write("scene.glb", to_glb(scene_, placed)));
  ASSERT_EQ(back.model.levels.size(), 1u);
  EXPECT_EQ(triangle_count(back.model.levels[0]), 2 + 4 + 8);
  back.update_bounds();
  const Eigen::AlignedBox3f bounds = back.model.bounds;
  EXPECT_NEAR((bounds.min() - Eigen::Vector3f(0.999f, -2.4f, -0.3f)).norm(), 0, 1e-5);
  EXPECT_NEAR((bounds.max() - Eigen::Vector3f(20, 3, 1.1f)).norm(), 0, 1e-5);
  ASSERT_EQ(back.materials.size(), 1u);
  EXPECT_EQ(back.materials[0].colour, Eigen::Vector3f(0.2f, 0.4f, 0.6f));
}

/// The sides of a wire face outwards.
TEST_F(ViewExportTest, AWireIsSeenFromOutside) {
  scene_.wires.push_back({{1, 0, 1}, {1, 3, 1}, 0.001f, 0});
  std::vector<PlacedMesh> placed;
  add_wires(scene_, view_, placed);
  const Primitive& wire = scene_.models.back().levels[0].primitives[0];
  for (std::size_t i = 0; i < wire.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return wire.vertices[wire.indices[i + k]].position; };
    const Eigen::Vector3f normal = (at(1) - at(0)).cross(at(2) - at(0));
    const Eigen::Vector3f middle = (at(0) + at(1) + at(2)) / 3;
    EXPECT_GT(normal.dot(Eigen::Vector3f(middle.x() - 1, 0, middle.z() - 1)), 0);
  }
}

}  // namespace
}  // namespace vinebench::sim
