// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/sun_view.h"

#include <cmath>

#include "core/util/error.h"

namespace vinebench::sim {

Eigen::Matrix3d sun_from_world(const Eigen::Vector3d& towards_sun) {
  const Eigen::Vector3d z = -towards_sun.normalized();
  const Eigen::Vector3d help =
      std::abs(z.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = help.cross(z).normalized();
  Eigen::Matrix3d m;
  m << x.transpose(), z.cross(x).transpose(), z.transpose();
  return m;
}

Eigen::Matrix4d light_from_world(const Eigen::Matrix3d& R_sun_world,
                                 const Eigen::AlignedBox3d& box) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  const double margin = 0.02 + 0.01 * box.sizes().maxCoeff();
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * box.sizes()[axis] + margin;
    m.row(axis).head<3>() = R_sun_world.row(axis) / half;
    m(axis, 3) = -box.center()[axis] / half;
  }
  return m;
}

Eigen::Matrix4d map_from_light() {
  Eigen::Matrix4d m = 0.5 * Eigen::Matrix4d::Identity();
  m.col(3) << 0.5, 0.5, 0.5, 1;
  return m;
}

GlFramebuffer make_depth_framebuffer(const GlFunctions& gl, const GlTexture& texture) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  GlFramebuffer framebuffer(gl, name);
  gl.BindFramebuffer(GL_FRAMEBUFFER, name);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture.get(), 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail("renderer: OpenGL gives no shadow map");
  }
  return framebuffer;
}

}  // namespace vinebench::sim
