// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/shadow_map.h"

#include <algorithm>

#include "sim/render/gl/scene/shaders.h"
#include "sim/render/gl/shadows/sun_view.h"

namespace vinebench::sim {
namespace {

/// What casts shadows, in the sun's axes.
Eigen::AlignedBox3d casters(const GpuScene& scene, const Eigen::Matrix3d& R_sun_world) {
  Eigen::AlignedBox3d box;
  for (const GpuInstance& instance : scene.instances) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(instance.model)];
    if (!model.casts_shadow || model.bounds.isEmpty() || instance.moves) continue;
    for (int i = 0; i < 8; ++i) {
      const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
      const Eigen::Vector3d p = model.bounds.corner(corner).cast<double>();
      box.extend(R_sun_world * (instance.world_from_model * p.homogeneous()).head<3>());
    }
  }
  return box;
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

}  // namespace

ShadowMap::ShadowMap(const GpuScene& scene, int size)
    : texture_(make_depth_texture(scene.gl, std::max(1, size))) {
  const GlFunctions& gl = scene.gl;
  const Eigen::Matrix3d R_sun_world = sun_from_world(scene.light.towards_sun.cast<double>());
  const Eigen::AlignedBox3d box = casters(scene, R_sun_world);
  const bool empty = size == 0 || box.isEmpty();
  const GlFramebuffer framebuffer = make_depth_framebuffer(gl, texture_);
  gl.Viewport(0, 0, std::max(1, size), std::max(1, size));
  gl.DepthMask(GL_TRUE);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  if (!empty) {
    const Eigen::Matrix4d light = light_from_world(R_sun_world, box);
    texel_ = box.sizes().head<2>().maxCoeff() / size;
    map_from_world_ = map_from_light() * light;
    draw(scene, light);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void ShadowMap::draw(const GpuScene& scene, const Eigen::Matrix4d& light) {
  const GlFunctions& gl = scene.gl;
  const GlProgram opaque(gl, "shadow", shadow_vertex_shader(), shadow_fragment_shader(false));
  const GlProgram cutout(gl, "shadow of a cut-out", shadow_vertex_shader(),
                         shadow_fragment_shader(true));
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(1.5f, 2.0f);
  gl.ActiveTexture(GL_TEXTURE0);
  std::vector<InstanceRow> rows;
  for (const GpuInstance& instance : scene.instances) {
    rows.push_back({(light * instance.world_from_model).topRows<3>().cast<float>(), 0});
  }
  scene.set_instances(rows);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(scene.instances[i].model)];
    if (!model.casts_shadow || scene.instances[i].moves) continue;
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

}  // namespace vinebench::sim
