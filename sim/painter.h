// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "sim/draw_list.h"
#include "sim/gpu_scene.h"
#include "sim/shaders.h"
#include "sim/shadow_map.h"

namespace vinebench {

/// Draws a scene into the bound target: what stands in it from near to far, then ground, sky and
/// wires. Alpha becomes the label of what a pixel shows. Lives and dies in a current context.
class Painter {
 public:
  Painter(const Scene& scene, int shadow_map_size);
  void draw(const PinholeCamera& camera, const Pose& T_world_cam, double lod_scale);

 private:
  struct MeshProgram {
    GlProgram program;
    GLint surface = -1;
    GLint leaf = -1;
  };
  struct View;

  void add_program(const Material& material);
  void use_for(const MeshProgram& mesh, const Material& material) const;
  void set_view(const GlProgram& program, const View& view) const;
  void draw_meshes(const DrawList& list, bool ground) const;
  void draw_primitive(const GpuPrimitive& primitive, const DrawBatch& batch) const;
  void draw_sky(const View& view) const;
  void draw_wires(const View& view) const;

  GpuScene scene_;
  ShadowMap shadow_map_;
  std::map<int, MeshProgram> programs_;  // by MeshShader::key()
  GlProgram sky_program_;
  GlTexture sky_;
  GlVertexArray no_vertices_;
  GlProgram wire_program_;
  GlBuffer instances_;
};

}  // namespace vinebench
