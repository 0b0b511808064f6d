// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/render/gl/draw_list.h"
#include "sim/render/gl/scene/gpu_scene.h"
#include "sim/render/gl/scene/mesh_programs.h"
#include "sim/render/gl/scene/view_block.h"
#include "sim/render/gl/shadows/light_map.h"
#include "sim/render/gl/shadows/moving_shadow.h"
#include "sim/render/gl/shadows/shadow_map.h"
#include "sim/render/gl/visible_wires.h"

namespace vinebench::sim {

/// What a view draws beside its image. Depth of wires comes with any of it.
struct TruthParts {
  bool depth = false;
  bool instances = false;
  bool normals = false;
  bool motion = false;
  bool any() const { return depth || instances || normals || motion; }
};

/// Draws a scene: what stands in it from near to far, then ground, sky and
/// wires. Alpha becomes the label of what a pixel shows. Lives and dies in a current context.
class Painter {
 public:
  Painter(const GlFunctions& gl, const Scene& scene, int shadow_map_size);
  /// Binds the target and draws into it; where `truth` asks for any, it must take the truth too.
  void draw(const GlTarget& target, const PinholeCamera& camera, const Pose& T_world_cam,
            const std::optional<Pose>& T_world_rover, double lod_scale,
            const ViewSettings& settings, const TruthParts& truth);

 private:
  void clear(const TruthParts& truth, float sky_brightness) const;
  void draw_meshes(const DrawList& list, bool terrain, bool truth);
  void draw_sky(const ViewBlock& view) const;
  void draw_wires(const PinholeCamera& camera, const Pose& T_world_cam,
                  const TruthParts& truth) const;
  void draw_wire_pieces(const GlProgram& program, const std::vector<VisibleWires>& wires) const;
  MoversInView cast_shadows(std::vector<Mover> movers, const PinholeCamera& camera,
                            const Pose& T_world_cam);
  void bind_maps() const;
  MeshShader shader_of(const Material& material, bool truth) const;

  const GlFunctions& gl_;
  GpuScene scene_;
  ViewBuffer view_;
  MeshPrograms programs_;
  ShadowMap shadow_map_;
  LightMap light_map_;
  MovingShadow moving_shadow_;
  GlSampler coarse_shadows_;  ///< for vertices
  GlProgram sky_program_;
  GlTexture sky_;
  GlVertexArray no_vertices_;
  GlProgram wire_program_;
  GlProgram wire_truth_program_;
  Eigen::Vector4f below_sky_;  ///< what the sky's image shows below the horizon
  float ground_light_ = 1;     ///< brightness of the light map, encoded
};

}  // namespace vinebench::sim
