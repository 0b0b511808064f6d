// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/visible_wires.h"

#include "core/geometry/rig.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

class VisibleWiresTest : public test::GlTest {
 protected:
  /// Vertices drawn by a camera at the origin that looks along +x.
  int vertices_of(const Wire& wire) const {
    Scene scene;
    test::add_material(scene, Label::kWire, Eigen::Vector3f::Ones());
    scene.wires.push_back(wire);
    const GpuScene gpu(gl_, scene);
    int count = 0;
    const Pose T_world_cam = Rig::mount({0, 0, 0.5}, {0, 0, 0});
    for (const VisibleWires& run : visible_wires(gpu, test::small_camera(), T_world_cam)) {
      count += run.count;
    }
    return count;
  }
};

TEST_F(VisibleWiresTest, OneInViewIsDrawnWhole) {
  // 2 m in pieces of 0.25 m, each of two triangles: 8 * 6 vertices. It crosses the border between
  // two places at y = 0, which are one run.
  EXPECT_EQ(vertices_of({{2, -1, 0.6f}, {2, 1, 0.6f}}), 48);
}

TEST_F(VisibleWiresTest, OneBehindIsNot) {
  EXPECT_EQ(vertices_of({{-6, -1, 0.6f}, {-6, 1, 0.6f}}), 0);
}

TEST_F(VisibleWiresTest, OneTooFarToChangeAPixelIsNot) {
  // 2.4 mm at 263 px are 0.02 px at 31.6 m; a thick one still counts there.
  EXPECT_GT(vertices_of({{30, -1, 0.6f}, {30, 1, 0.6f}}), 0);
  EXPECT_EQ(vertices_of({{36, -1, 0.6f}, {36, 1, 0.6f}}), 0);
  EXPECT_GT(vertices_of({{36, -1, 0.6f}, {36, 1, 0.6f}, 0.008f}), 0);
}

}  // namespace
}  // namespace vinebench::sim
