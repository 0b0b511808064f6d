// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/painter.h"

#include <array>
#include <utility>

#include "sim/render/gl/scene/shaders.h"
#include "sim/render/gl/sky.h"
#include "sim/render/gl/sky_rows.h"

namespace vinebench::sim {
namespace {

/// Draws into the image, or not, and into what is asked for of the truth.
void draw_into(const GlFunctions& gl, bool image, const TruthParts& truth) {
  const auto target = [](bool wanted, GLenum attachment) -> GLenum {
    return wanted ? attachment : GL_NONE;
  };
  const std::array targets{
      target(image, GL_COLOR_ATTACHMENT0), target(truth.instances, GL_COLOR_ATTACHMENT1),
      target(truth.normals, GL_COLOR_ATTACHMENT2), target(truth.motion, GL_COLOR_ATTACHMENT3)};
  gl.DrawBuffers(truth.any() ? static_cast<GLsizei>(targets.size()) : 1, targets.data());
}

}  // namespace

Painter::Painter(const GlFunctions& gl, const Scene& scene, int shadow_map_size)
    : gl_(gl),
      scene_(gl, scene),
      view_(gl),
      programs_(gl),
      shadow_map_(scene_, shadow_map_size),
      light_map_(scene_, shadow_map_, programs_, view_, shadow_map_size),
      moving_shadow_(scene_, shadow_map_size),
      coarse_shadows_(make_coarse_depth_sampler(gl)),
      sky_program_(gl, "sky", sky_vertex_shader(), sky_fragment_shader()),
      no_vertices_(make_vertex_array(gl)),
      wire_program_(gl, "wire", wire_vertex_shader(), wire_fragment_shader(false)),
      wire_truth_program_(gl, "truth of a wire", wire_vertex_shader(), wire_fragment_shader(true)) {
  const cv::Mat sky = sky_image(scene.light, scene.seed);
  sky_ = make_texture(gl, {sky}, false);
  below_sky_ = below_horizon(sky);
  for (GpuInstance& instance : scene_.instances) instance.open = light_map_.is_open(instance);
  for (const Material& material : scene.materials) programs_.get(shader_of(material, false));
  check_gl(gl, "uploading the scene");
}

MeshShader Painter::shader_of(const Material& material, bool truth) const {
  MeshShader shader = shader_for(material);
  shader.haze = scene_.light.haze > 0;
  shader.wind = scene_.wind.speed > 0 && !material.terrain;
  shader.truth = truth;
  return shader;
}

void Painter::clear(const TruthParts& truth, float sky_brightness) const {
  const Eigen::Vector4f below = sky_brightness * below_sky_;
  draw_into(gl_, true, {});
  gl_.ClearColor(below.x(), below.y(), below.z(), 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (!truth.any()) return;
  draw_into(gl_, false, truth);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  draw_into(gl_, true, truth);
}

void Painter::draw_meshes(const DrawList& list, bool terrain, bool truth) {
  int material_in_use = -1;
  bool shaded_in_use = false, open_in_use = false;
  for (const DrawBatch& batch : list.batches) {
    const GpuModel& model = scene_.models[static_cast<std::size_t>(batch.model)];
    for (const GpuPrimitive& primitive :
         model.levels[static_cast<std::size_t>(batch.level)].primitives) {
      const Material& material = scene_.materials[static_cast<std::size_t>(primitive.material)];
      if (material.terrain != terrain) continue;
      const bool open = batch.open && material.terrain;
      if (primitive.material != material_in_use || batch.shaded != shaded_in_use ||
          open != open_in_use) {
        MeshShader shader = shader_of(material, truth);
        shader.moving = batch.shaded;
        shader.open = open;
        const Eigen::Vector3f light = open ? light_map_.open_light() : Eigen::Vector3f::Ones();
        programs_.get(shader).use_for(material, shadow_map_.texel(), ground_light_ * light);
        if (material.texture >= 0) {
          gl_.BindTexture(GL_TEXTURE_2D,
                          scene_.textures[static_cast<std::size_t>(material.texture)].get());
        }
        material_in_use = primitive.material;
        shaded_in_use = batch.shaded;
        open_in_use = open;
      }
      scene_.draw(primitive, batch.order, batch.first, batch.count);
    }
  }
}

void Painter::draw_sky(const ViewBlock& view) const {
  sky_program_.use();
  // The clip space's x and y to the camera's ray of z = 1, and that into the world.
  const Eigen::Matrix4f& clip = view.clip_from_cam;
  Eigen::Matrix4f ray_from_clip = Eigen::Matrix4f::Zero();
  ray_from_clip.col(0).head<3>() = Eigen::Vector3f(1 / clip(0, 0), 0, 0);
  ray_from_clip.col(1).head<3>() = Eigen::Vector3f(0, 1 / clip(1, 1), 0);
  ray_from_clip.col(2).head<3>() =
      Eigen::Vector3f(-clip(0, 2) / clip(0, 0), -clip(1, 2) / clip(1, 1), 1);
  const Eigen::Matrix3f R_world_cam = view.world_from_cam.topLeftCorner<3, 3>();
  ray_from_clip.topRows<3>() = (R_world_cam * ray_from_clip.topRows<3>()).eval();
  gl_.UniformMatrix4fv(sky_program_.uniform("ray_from_clip"), 1, GL_FALSE, ray_from_clip.data());
  const GLint range = sky_program_.uniform("rows");
  gl_.Disable(GL_CULL_FACE);
  bind_texture(gl_, kImageUnit, sky_);
  gl_.BindVertexArray(no_vertices_.get());
  for (const Eigen::Vector2f& rows : rows_with_sky(ray_from_clip)) {
    gl_.Uniform2fv(range, 1, rows.data());
    gl_.DrawArrays(GL_TRIANGLES, 0, 6);
  }
}

void Painter::draw_wire_pieces(const GlProgram& program,
                               const std::vector<VisibleWires>& wires) const {
  program.use();
  gl_.Disable(GL_CULL_FACE);
  for (const VisibleWires& visible : wires) {
    const GpuWires& of = scene_.wires[visible.wires];
    const Material& material = scene_.materials[static_cast<std::size_t>(of.material)];
    gl_.Uniform4fv(program.uniform("surface"), 1, surface_of(material).data());
    gl_.BindVertexArray(of.array.get());
    gl_.DrawArrays(GL_TRIANGLES, visible.first, visible.count);
  }
}

void Painter::draw_wires(const PinholeCamera& camera, const Pose& T_world_cam,
                         const TruthParts& truth) const {
  const std::vector<VisibleWires> wires = visible_wires(scene_, camera, T_world_cam);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC1_COLOR, GL_ONE_MINUS_SRC1_COLOR);
  draw_wire_pieces(wire_program_, wires);
  gl_.Disable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ZERO);  // two sources forbid several targets even where nothing blends
  gl_.DepthMask(GL_TRUE);
  if (!truth.any()) return;
  // Blending by two sources has but one target, so the wires' truth is drawn by itself.
  draw_into(gl_, false, truth);
  draw_wire_pieces(wire_truth_program_, wires);
}

MoversInView Painter::cast_shadows(std::vector<Mover> movers, const PinholeCamera& camera,
                                   const Pose& T_world_cam) {
  const bool shade = moving_shadow_.cast(scene_, movers, camera, T_world_cam);
  return {std::move(movers), shade ? &moving_shadow_ : nullptr};
}

void Painter::bind_maps() const {
  bind_texture(gl_, kGroundLightUnit, light_map_.texture());
  bind_texture(gl_, kShadowUnit, shadow_map_.texture());
  bind_texture(gl_, kCoarseShadowUnit, shadow_map_.texture());
  gl_.BindSampler(kCoarseShadowUnit, coarse_shadows_.get());
  bind_texture(gl_, kMovingShadowUnit, moving_shadow_.texture());
  gl_.ActiveTexture(GL_TEXTURE0 + kImageUnit);
}

void Painter::draw(const GlTarget& target, const PinholeCamera& camera, const Pose& T_world_cam,
                   const std::optional<Pose>& T_world_rover, double lod_scale,
                   const ViewSettings& settings, const TruthParts& truth) {
  const MoversInView moving =
      cast_shadows(scene_.movers(settings.time, T_world_rover), camera, T_world_cam);
  target.bind();
  ViewBlock view = make_view_block(camera, T_world_cam, scene_.light, scene_.wind, settings);
  view.shadow_from_cam = (shadow_map_.map_from_world() * T_world_cam.matrix()).cast<float>();
  if (moving.shadow != nullptr) {
    view.moving_shadow_from_cam =
        (moving_shadow_.map_from_world() * T_world_cam.matrix()).cast<float>();
  }
  view.light_map = light_map_.map_from_world();
  view.lens.z() *= static_cast<float>(kSkyBrightest);
  view_.set(view);
  ground_light_ =
      static_cast<float>(LightMap::kBrightest * static_cast<double>(encoded(settings.exposure)));
  const DrawList list = make_draw_list(scene_, camera, T_world_cam, lod_scale, moving);
  scene_.set_instances(list.rows);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.DepthMask(GL_TRUE);
  gl_.FrontFace(GL_CW);
  gl_.Disable(GL_BLEND);
  clear(truth, view.lens.z());
  bind_maps();
  draw_meshes(list, false, truth.any());
  draw_meshes(list, true, truth.any());
  draw_into(gl_, true, {});
  draw_sky(view);
  draw_wires(camera, T_world_cam, truth);
  gl_.BindVertexArray(0);
}

}  // namespace vinebench::sim
