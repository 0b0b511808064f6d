// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/rover_shadow.h"

#include <algorithm>

#include "sim/render/gl/scene/frustum.h"
#include "sim/render/gl/scene/shaders.h"
#include "sim/render/gl/shadows/sun_view.h"

namespace vinebench::sim {
namespace {

constexpr int kMapSize = 256;          // pixels a side: 3 mm each
constexpr double kLowestSun = 0.02;    // sine of its elevation
constexpr double kLongestShadow = 15;  // m; of a low sun, longer ones are not looked for
constexpr double kUnevenGround = 0.5;  // m that the ground may lie below the rover's own

bool same(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

bool casts(const GpuScene& scene, int size) {
  return size > 0 && scene.rover_model >= 0 && !scene.light.sun.isZero() &&
         scene.light.towards_sun.normalized().z() > static_cast<float>(kLowestSun);
}

}  // namespace

RoverShadow::RoverShadow(const GpuScene& scene, int size)
    : casts_(casts(scene, size)),
      towards_sun_(scene.light.towards_sun.cast<double>().normalized()),
      R_sun_world_(sun_from_world(towards_sun_)),
      size_(casts_ ? std::min(kMapSize, size) : 1),
      texture_(make_depth_texture(scene.gl, size_)),
      framebuffer_(make_depth_framebuffer(scene.gl, texture_)),
      program_(scene.gl, "shadow of the rover", shadow_vertex_shader(),
               shadow_fragment_shader(false)) {
  scene.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

bool RoverShadow::cast(const GpuScene& scene, const Pose& T_world_rover,
                       const PinholeCamera& camera, const Pose& T_world_cam) {
  if (!casts_ || !may_be_seen(scene.rover_corners, T_world_rover, camera, T_world_cam))
    return false;
  if (drawn_ && same(*drawn_, T_world_rover)) return true;
  box_.setEmpty();
  for (const Eigen::Vector3d& corner : scene.rover_corners) {
    box_.extend(R_sun_world_ * (T_world_rover * corner));
  }
  draw(scene, T_world_rover);
  drawn_ = T_world_rover;
  return true;
}

/// The rover and the ends of its shadow on a ground that may fall off.
bool RoverShadow::may_be_seen(const std::vector<Eigen::Vector3d>& corners,
                              const Pose& T_world_rover, const PinholeCamera& camera,
                              const Pose& T_world_cam) const {
  const double ground = T_world_rover.translation.z() - kUnevenGround;
  const Pose T_cam_world = T_world_cam.inverse();
  std::vector<Eigen::Vector3d> hull;
  hull.reserve(2 * corners.size());
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d p = T_world_rover * corner;
    const double reach = std::clamp((p.z() - ground) / towards_sun_.z(), 0.0, kLongestShadow);
    hull.push_back(T_cam_world * p);
    hull.push_back(T_cam_world * (p - reach * towards_sun_));
  }
  return Frustum(camera).may_see(hull);
}

void RoverShadow::draw(const GpuScene& scene, const Pose& T_world_rover) const {
  const GlFunctions& gl = scene.gl;
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl.Viewport(0, 0, size_, size_);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.DepthMask(GL_TRUE);
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_BLEND);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5f, 2.0f);
  const Eigen::Matrix4d light_from_rover =
      light_from_world(R_sun_world_, box_) * T_world_rover.matrix();
  scene.set_instances({{light_from_rover.topRows<3>().cast<float>(), 0}});
  program_.use();
  const GpuModel& rover = scene.models[static_cast<std::size_t>(scene.rover_model)];
  for (const GpuPrimitive& primitive : rover.levels.back().primitives) {
    scene.draw(primitive, 0, 0, 1);
  }
  gl.BindVertexArray(0);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
}

bool RoverShadow::may_shade(const Eigen::Vector3d& centre, double radius) const {
  const Eigen::Vector3d p = R_sun_world_ * centre;
  const Eigen::Vector3d beyond = (box_.min() - p).cwiseMax(Eigen::Vector3d::Zero());
  const Eigen::Vector3d before = (p - box_.max()).cwiseMax(Eigen::Vector3d::Zero());
  return (beyond + before).head<2>().norm() <= radius && beyond.z() <= radius;
}

Eigen::Matrix4d RoverShadow::map_from_world() const {
  return map_from_light() * light_from_world(R_sun_world_, box_);
}

}  // namespace vinebench::sim
