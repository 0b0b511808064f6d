// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/shadow_map.h"

#include <algorithm>

#include "sim/shaders.h"
#include "slam/base/error.h"

namespace vinebench {
namespace {

/// Axes of the sun's view: z away from the sun.
Eigen::Matrix3d sun_from_world(const Eigen::Vector3d& towards_sun) {
  const Eigen::Vector3d z = -towards_sun.normalized();
  const Eigen::Vector3d help =
      std::abs(z.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = help.cross(z).normalized();
  Eigen::Matrix3d m;
  m << x.transpose(), z.cross(x).transpose(), z.transpose();
  return m;
}

/// What casts shadows, in the sun's axes.
Eigen::AlignedBox3d casters(const GpuScene& scene, const Eigen::Matrix3d& R_sun_world) {
  Eigen::AlignedBox3d box;
  for (const GpuInstance& instance : scene.instances) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(instance.model)];
    if (!model.casts_shadow || model.bounds.isEmpty()) continue;
    for (int i = 0; i < 8; ++i) {
      const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
      const Eigen::Vector3d p = model.bounds.corner(corner).cast<double>();
      box.extend(R_sun_world * (instance.world_from_model * p.homogeneous()).head<3>());
    }
  }
  return box;
}

/// Orthographic: the box's x and y to the clip space's, z to its depth.
Eigen::Matrix4d light_matrix(const Eigen::Matrix3d& R_sun_world, const Eigen::AlignedBox3d& box) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  const double margin = 0.02 + 0.01 * box.sizes().maxCoeff();
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * box.sizes()[axis] + margin;
    m.row(axis).head<3>() = R_sun_world.row(axis) / half;
    m(axis, 3) = -box.center()[axis] / half;
  }
  return m;
}

/// Finer than a texel need not be drawn: the level that a camera would draw at whose pixels are as
/// large.
const GpuLevel& caster_level(const GpuModel& model, double texel) {
  const double distance = texel * kLevelFocalLength;
  for (const GpuLevel& level : model.levels) {
    if (distance < level.until) return level;
  }
  return model.levels.back();
}

GlFramebuffer depth_framebuffer(const GlTexture& texture) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  GlFramebuffer framebuffer(name);
  gl.BindFramebuffer(GL_FRAMEBUFFER, name);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture.get(), 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail("renderer: OpenGL gives no shadow map");
  }
  return framebuffer;
}

}  // namespace

ShadowMap::ShadowMap(const GpuScene& scene, int size)
    : texture_(make_depth_texture(std::max(1, size))) {
  const Eigen::Matrix3d R_sun_world = sun_from_world(scene.light.towards_sun.cast<double>());
  const Eigen::AlignedBox3d box = casters(scene, R_sun_world);
  const bool empty = size == 0 || box.isEmpty();
  const GlFramebuffer framebuffer = depth_framebuffer(texture_);
  gl.Viewport(0, 0, std::max(1, size), std::max(1, size));
  gl.DepthMask(GL_TRUE);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  if (!empty) {
    const Eigen::Matrix4d light_from_world = light_matrix(R_sun_world, box);
    texel_ = box.sizes().head<2>().maxCoeff() / size;
    Eigen::Matrix4d map_from_light = 0.5 * Eigen::Matrix4d::Identity();
    map_from_light.col(3) << 0.5, 0.5, 0.5, 1;
    map_from_world_ = map_from_light * light_from_world;
    draw(scene, light_from_world);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void ShadowMap::draw(const GpuScene& scene, const Eigen::Matrix4d& light_from_world) {
  const GlProgram opaque("shadow", shadow_vertex_shader(), shadow_fragment_shader(false));
  const GlProgram cutout("shadow of a cut-out", shadow_vertex_shader(),
                         shadow_fragment_shader(true));
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5f, 2.0f);
  gl.ActiveTexture(GL_TEXTURE0);
  std::vector<InstanceRow> rows;
  for (const GpuInstance& instance : scene.instances) {
    rows.push_back({(light_from_world * instance.world_from_model).topRows<3>().cast<float>(), 0});
  }
  scene.set_instances(rows);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(scene.instances[i].model)];
    if (!model.casts_shadow) continue;
    for (const GpuPrimitive& primitive : caster_level(model, texel_).primitives) {
      const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      const bool holes = material.cutout && material.texture >= 0;
      (holes ? cutout : opaque).use();
      if (holes) {
        gl.BindTexture(GL_TEXTURE_2D,
                       scene.textures[static_cast<std::size_t>(material.texture)].get());
      }
      scene.draw(primitive, 0, i, 1);
    }
  }
  gl.BindVertexArray(0);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace vinebench
