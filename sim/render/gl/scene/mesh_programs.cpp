// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/mesh_programs.h"

#include "sim/render/gl/scene/view_block.h"

namespace vinebench::sim {
namespace {

/// How far the wind moves it, against a leaf.
float sway_of(Label label) {
  switch (label) {
    case Label::kLeaf:
      return 1.0f;
    case Label::kGrass:
      return 0.8f;
    case Label::kCane:
      return 0.6f;
    case Label::kBunch:
      return 0.25f;
    default:
      return 0;
  }
}

}  // namespace

MeshShader shader_for(const Material& material) {
  MeshShader shader;
  shader.textured = material.texture >= 0;
  shader.cutout = shader.textured && material.cutout;
  shader.coloured = material.vertex_colours;
  switch (material.label) {
    case Label::kTag:
    case Label::kBox:
    case Label::kCrate:
    case Label::kTarpaulin:
    case Label::kOccluder:
    case Label::kRover:
      shader.shadows = MeshShader::Shadows::kPixels;
      break;
    default:
      break;
  }
  if (material.terrain) shader.shadows = MeshShader::Shadows::kLightMap;
  return shader;
}

Eigen::Vector4f surface_of(const Material& material) {
  const Eigen::Vector3f& colour = material.colour;
  return {colour.x(), colour.y(), colour.z(), static_cast<float>(material.label) / 255.0f};
}

MeshProgram::MeshProgram(const GlFunctions& gl, const MeshShader& shader)
    : gl_(gl),
      program_(gl, "mesh", mesh_vertex_shader(shader), mesh_fragment_shader(shader)),
      surface_(program_.uniform("surface")),
      leaf_(program_.uniform("leaf")),
      sway_(program_.uniform("sway")),
      tint_(program_.uniform("tint")) {}

void MeshProgram::use_for(const Material& material, double shadow_texel,
                          const Eigen::Vector3f& ground_light) const {
  program_.use();
  gl_.Uniform4fv(surface_, 1, surface_of(material).data());
  // Away from the surface so that it does not shade itself; leaves further, as their own plant's
  // foliage is what the map is too coarse for.
  const bool foliage = material.double_sided || material.label == Label::kBunch;
  const auto along_normal = static_cast<float>(foliage ? 0 : 2 * shadow_texel);
  const Eigen::Vector4f leaf(material.translucency, material.double_sided ? 1 : 0, along_normal,
                             foliage ? 0.03f : 0.002f);
  gl_.Uniform4fv(leaf_, 1, leaf.data());
  gl_.Uniform1f(sway_, sway_of(material.label));
  const Eigen::Vector3f tint(encoded(material.colour.x()), encoded(material.colour.y()),
                             encoded(material.colour.z()));
  gl_.Uniform3fv(tint_, 1, Eigen::Vector3f(ground_light.cwiseProduct(tint)).data());
  (material.double_sided ? gl_.Disable : gl_.Enable)(GL_CULL_FACE);
}

const MeshProgram& MeshPrograms::get(const MeshShader& shader) {
  return programs_.try_emplace(shader.key(), gl_, shader).first->second;
}

}  // namespace vinebench::sim
