// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/world_views.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::harness {
namespace {

/// Two rows along x, 2 m apart.
ViewsRequest request(ViewKind kind) {
  ViewsRequest views;
  views.simulation.world.rows = {{{0, 0}, {10, 0}}, {{0, 2}, {10, 2}}};
  views.simulation.renderer.engine = sim::RenderEngineKind::kFake;
  views.kind = kind;
  views.count = 40;
  return views;
}

/// Where the view's middle meets the vertical plane of a row at that y; m along x.
double meets(const View& view, double y) {
  const Eigen::Vector3d ahead = view.T_world_cam.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d& from = view.T_world_cam.translation;
  return from.x() + (y - from.y()) / ahead.y() * ahead.x();
}

TEST(WorldViewsTest, FromTheSideARowIsLookedAtAcrossItsAisle) {
  for (const View& view : draw_views(request(ViewKind::kSide))) {
    const double y = view.T_world_cam.translation.y();
    const double facing = (view.T_world_cam.rotation * Eigen::Vector3d::UnitZ()).y();
    // Within 1.8 m of a row, and 0.4 m from the other.
    const bool between = y > 0.4 - 1e-9 && y < 1.6 + 1e-9;
    const bool outside = (y < -0.89 && y > -1.81) || (y > 2.89 && y < 3.81);
    EXPECT_TRUE(between || outside) << y;
    EXPECT_GT(std::abs(facing), std::cos(0.4));  // 12 degrees aside, 10 down
    const double row = y < 0 ? 0 : y > 2 ? 2 : facing > 0 ? 2 : 0;
    EXPECT_GT(meets(view, row), -0.5);
    EXPECT_LT(meets(view, row), 10.5);
  }
}

TEST(WorldViewsTest, AheadIsAlongTheAislesMiddle) {
  for (const View& view : draw_views(request(ViewKind::kAhead))) {
    const double y = view.T_world_cam.translation.y();
    EXPECT_TRUE(std::abs(y - 1) < 1e-9 || y < -0.59 || y > 2.59) << y;
    EXPECT_GT((view.T_world_cam.rotation * Eigen::Vector3d::UnitZ()).x(), std::cos(0.3));
  }
}

}  // namespace
}  // namespace vinebench::harness
