// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "sim/render/gl/platform/gl_objects.h"
#include "sim/render/gl/scene/mesh_shaders.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Texture units of all programs.
inline constexpr GLint kImageUnit = 0;
inline constexpr GLint kShadowUnit = 1;
inline constexpr GLint kGroundLightUnit = 2;
inline constexpr GLint kCoarseShadowUnit = 3;
inline constexpr GLint kMovingShadowUnit = 4;

/// The leanest shader that shows the material.
MeshShader shader_for(const Material& material);

/// The shaders' `surface`: linear colour, and the label as alpha.
Eigen::Vector4f surface_of(const Material& material);

/// A linked mesh shader and the places of what changes from material to material.
class MeshProgram {
 public:
  MeshProgram(const GlFunctions& gl, const MeshShader& shader);
  /// Makes the program current for a material. `shadow_texel`: m, of the shadow map;
  /// `ground_light`: encoded, of the ground's light map at 1, or of open ground.
  void use_for(const Material& material, double shadow_texel,
               const Eigen::Vector3f& ground_light) const;

 private:
  const GlFunctions& gl_;
  GlProgram program_;
  GLint surface_;
  GLint leaf_;
  GLint sway_;
  GLint tint_;
};

/// Programs by what they do, each compiled when it is first asked for.
class MeshPrograms {
 public:
  explicit MeshPrograms(const GlFunctions& gl) : gl_(gl) {}
  const MeshProgram& get(const MeshShader& shader);

 private:
  const GlFunctions& gl_;
  std::map<int, MeshProgram> programs_;  // by MeshShader::key()
};

}  // namespace vinebench::sim
