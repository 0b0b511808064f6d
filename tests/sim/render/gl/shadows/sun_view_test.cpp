// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/sun_view.h"

#include "tests/support/gl_fixture.h"

namespace vinebench::sim {
namespace {

TEST(SunViewTest, ItsAxesAreARotationWithZAwayFromTheSun) {
  // The second is along x, where another axis must help.
  for (const Eigen::Vector3d& sun :
       {Eigen::Vector3d(0.2, 0.3, 0.9), {1, 0, 0.01}, {-1, 0, 0}, {0, 0, 1}}) {
    const Eigen::Matrix3d R_sun_world = sun_from_world(sun);
    EXPECT_LT((R_sun_world * R_sun_world.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R_sun_world.determinant(), 1, 1e-12);
    EXPECT_LT((R_sun_world * sun.normalized() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  }
}

TEST(SunViewTest, ABoxFillsTheClipSpaceButForItsMargin) {
  const Eigen::Matrix3d R_sun_world = sun_from_world({0.2, 0.3, 0.9});
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, 2, 3), Eigen::Vector3d(3, 4, 13));
  const Eigen::Matrix4d light = light_from_world(R_sun_world, box);
  const auto clip = [&](const Eigen::Vector3d& p_sun) -> Eigen::Vector3d {
    return (light * (R_sun_world.transpose() * p_sun).eval().homogeneous()).head<3>();
  };
  EXPECT_LT(clip(box.center()).norm(), 1e-12);
  // A margin of 2 cm and 1 % of the longest side: 0.12 m on half sides of 2, 1 and 5 m.
  const Eigen::Vector3d expected(2 / 2.12, 1 / 1.12, 5 / 5.12);
  EXPECT_LT((clip(box.max()) - expected).norm(), 1e-9);
  EXPECT_LT((clip(box.min()) + expected).norm(), 1e-9);
}

TEST(SunViewTest, AMapHasTheClipSpaceFromZeroToOne) {
  const Eigen::Vector4d low = map_from_light() * Eigen::Vector4d(-1, -1, -1, 1);
  const Eigen::Vector4d high = map_from_light() * Eigen::Vector4d(1, 1, 1, 1);
  EXPECT_LT((low - Eigen::Vector4d(0, 0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((high - Eigen::Vector4d(1, 1, 1, 1)).norm(), 1e-12);
}

class SunViewGlTest : public test::GlTest {};

TEST_F(SunViewGlTest, AFramebufferClearsItsTexture) {
  const GlTexture texture = make_depth_texture(gl_, 4);
  const GlFramebuffer framebuffer = make_depth_framebuffer(gl_, texture);
  const float half = 0.5f;
  gl_.DepthMask(GL_TRUE);
  gl_.ClearBufferfv(GL_DEPTH, 0, &half);
  EXPECT_EQ(cv::countNonZero(depths(texture, 4) != 0.5f), 0);
}

}  // namespace
}  // namespace vinebench::sim
