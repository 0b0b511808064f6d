// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/moving_shadow.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sim/render/gl/scene/frustum.h"
#include "sim/render/gl/scene/shaders.h"
#include "sim/render/gl/shadows/sun_view.h"

namespace vinebench::sim {
namespace {

constexpr int kRoverMapSize = 256;     // pixels a side: 3 mm each, where the rover moves alone
constexpr int kMapSize = 1024;         // 1 cm each of two movers 10 m apart
constexpr double kLowestSun = 0.02;    // sine of its elevation
constexpr double kLongestShadow = 15;  // m; of a low sun, longer ones are not looked for
constexpr double kFarthest = 25;       // m from the camera; shadows further away are not drawn
constexpr double kUnevenGround = 0.5;  // m that the ground may lie below a mover's own

bool same(const std::vector<Mover>& movers, const std::vector<Mover>& others) {
  return std::ranges::equal(movers, others, [](const Mover& one, const Mover& other) {
    const Pose &a = one.T_world_model, &b = other.T_world_model;
    return one.index == other.index && a.translation == b.translation &&
           a.rotation.coeffs() == b.rotation.coeffs();
  });
}

bool any_moves(const GpuScene& scene) {
  return std::ranges::any_of(scene.instances, &GpuInstance::moves);
}

bool casts(const GpuScene& scene, int size) {
  return size > 0 && (scene.rover_model >= 0 || any_moves(scene)) && !scene.light.sun.isZero() &&
         scene.light.towards_sun.normalized().z() > static_cast<float>(kLowestSun);
}

}  // namespace

MovingShadow::MovingShadow(const GpuScene& scene, int size)
    : casts_(casts(scene, size)),
      towards_sun_(scene.light.towards_sun.cast<double>().normalized()),
      R_sun_world_(sun_from_world(towards_sun_)),
      size_(casts_ ? std::min(any_moves(scene) ? kMapSize : kRoverMapSize, size) : 1),
      texture_(make_depth_texture(scene.gl, size_)),
      framebuffer_(make_depth_framebuffer(scene.gl, texture_)),
      program_(scene.gl, "shadow of what moves", shadow_vertex_shader(),
               shadow_fragment_shader(false)) {
  scene.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

bool MovingShadow::cast(const GpuScene& scene, const std::vector<Mover>& movers,
                        const PinholeCamera& camera, const Pose& T_world_cam) {
  if (!casts_) return false;
  std::vector<Mover> casters;
  std::ranges::copy_if(movers, std::back_inserter(casters), [&](const Mover& mover) {
    const bool rover = mover.index == scene.instances.size();
    const double away = (mover.placed.centre - T_world_cam.translation).norm();
    return (rover || away < kFarthest) && may_be_seen(mover, camera, T_world_cam);
  });
  if (casters.empty()) return false;
  if (same(casters, drawn_)) return true;
  box_.setEmpty();
  for (const Mover& mover : casters) {
    for (const Eigen::Vector3d& point : *mover.hull) {
      box_.extend(R_sun_world_ * mover.in_world(point));
    }
  }
  draw(scene, casters);
  drawn_ = std::move(casters);
  return true;
}

/// The mover and the ends of its shadow on a ground that may fall off.
bool MovingShadow::may_be_seen(const Mover& mover, const PinholeCamera& camera,
                               const Pose& T_world_cam) const {
  const double ground = mover.T_world_model.translation.z() - kUnevenGround;
  const Pose T_cam_world = T_world_cam.inverse();
  std::vector<Eigen::Vector3d> hull;
  hull.reserve(2 * mover.hull->size());
  for (const Eigen::Vector3d& point : *mover.hull) {
    const Eigen::Vector3d p = mover.in_world(point);
    const double reach = std::clamp((p.z() - ground) / towards_sun_.z(), 0.0, kLongestShadow);
    hull.push_back(T_cam_world * p);
    hull.push_back(T_cam_world * (p - reach * towards_sun_));
  }
  return Frustum(camera).may_see(hull);
}

void MovingShadow::draw(const GpuScene& scene, const std::vector<Mover>& casters) const {
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
  const Eigen::Matrix4d light = light_from_world(R_sun_world_, box_);
  std::vector<InstanceRow> rows;
  for (const Mover& mover : casters) {
    rows.push_back({(light * mover.placed.world_from_model).topRows<3>().cast<float>(), 0});
  }
  scene.set_instances(rows);
  program_.use();
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(casters[i].placed.model)];
    const bool rover = casters[i].placed.model == scene.rover_model;
    const GpuLevel& level = rover ? model.levels.back() : model.levels.front();
    for (const GpuPrimitive& primitive : level.primitives) scene.draw(primitive, 0, i, 1);
  }
  gl.BindVertexArray(0);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
}

bool MovingShadow::may_shade(const Eigen::Vector3d& centre, double radius) const {
  const Eigen::Vector3d p = R_sun_world_ * centre;
  const Eigen::Vector3d beyond = (box_.min() - p).cwiseMax(Eigen::Vector3d::Zero());
  const Eigen::Vector3d before = (p - box_.max()).cwiseMax(Eigen::Vector3d::Zero());
  return (beyond + before).head<2>().norm() <= radius && beyond.z() <= radius;
}

Eigen::Matrix4d MovingShadow::map_from_world() const {
  return map_from_light() * light_from_world(R_sun_world_, box_);
}

}  // namespace vinebench::sim
