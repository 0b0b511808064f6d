// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/painter.h"

#include "sim/sky.h"

namespace vinebench {
namespace {

constexpr GLint kPictureUnit = 0;
constexpr GLint kShadowUnit = 1;

/// Large even faces show the edge of a shadow; leaves and the like are small enough to be lit or
/// shaded by their vertices.
MeshShader shader_for(const Material& material) {
  MeshShader shader;
  shader.textured = material.texture >= 0;
  shader.cutout = shader.textured && material.cutout;
  switch (material.label) {
    case Label::kGround:
    case Label::kTrunk:
    case Label::kPost:
    case Label::kTag:
    case Label::kBox:
    case Label::kRover:
      shader.pixel_shadows = true;
      break;
    default:
      break;
  }
  return shader;
}

void set_matrix(GLint location, const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix4f m = matrix.cast<float>();
  gl.UniformMatrix4fv(location, 1, GL_FALSE, m.data());
}

void set_vector(GLint location, const Eigen::Vector3f& vector) {
  gl.Uniform3fv(location, 1, vector.data());
}

void set_surface(GLint location, const Material& material) {
  const Eigen::Vector4f surface(material.colour.x(), material.colour.y(), material.colour.z(),
                                static_cast<float>(material.label) / 255.0f);
  gl.Uniform4fv(location, 1, surface.data());
}

}  // namespace

/// The matrices of one picture.
struct Painter::View {
  View(const PinholeCamera& camera_in, const Pose& T_world_cam)
      : camera(camera_in),
        clip(clip_from_cam(camera_in)),
        world_from_cam(T_world_cam.matrix()),
        cam_from_world(T_world_cam.inverse().matrix()) {}
  PinholeCamera camera;
  Eigen::Matrix4d clip;
  Eigen::Matrix4d world_from_cam;
  Eigen::Matrix4d cam_from_world;
};

Painter::Painter(const Scene& scene, int shadow_map_size)
    : scene_(scene),
      shadow_map_(scene_, shadow_map_size),
      sky_program_("sky", sky_vertex_shader(), sky_fragment_shader()),
      sky_(make_texture({sky_picture(scene.light, scene.seed)}, false)),
      no_vertices_(make_vertex_array()),
      wire_program_("wire", wire_vertex_shader(), wire_fragment_shader()),
      instances_(make_buffer(GL_ARRAY_BUFFER, nullptr, 0)) {
  for (const Material& material : scene.materials) add_program(material);
  check_gl("uploading the scene");
}

void Painter::add_program(const Material& material) {
  const MeshShader shader = shader_for(material);
  if (programs_.contains(shader.key())) return;
  MeshProgram& mesh = programs_[shader.key()];
  mesh.program = GlProgram("mesh", mesh_vertex_shader(shader), mesh_fragment_shader(shader));
  mesh.surface = mesh.program.uniform("surface");
  mesh.leaf = mesh.program.uniform("leaf");
}

void Painter::set_view(const GlProgram& program, const View& view) const {
  program.use();
  const Eigen::Matrix3f R_cam_world = view.cam_from_world.topLeftCorner<3, 3>().cast<float>();
  set_matrix(program.uniform("clip_from_cam"), view.clip);
  set_matrix(program.uniform("cam_from_world"), view.cam_from_world);
  set_matrix(program.uniform("shadow_from_cam"),
             shadow_map_.map_from_world() * view.world_from_cam);
  set_vector(program.uniform("towards_sun"), R_cam_world * scene_.light.towards_sun);
  set_vector(program.uniform("up"), R_cam_world.col(2));
  set_vector(program.uniform("sun"), scene_.light.sun);
  set_vector(program.uniform("sky"), scene_.light.sky);
  set_vector(program.uniform("bounce"), scene_.light.bounce);
  gl.Uniform1i(program.uniform("picture"), kPictureUnit);
  gl.Uniform1i(program.uniform("shadow_map"), kShadowUnit);
}

void Painter::use_for(const MeshProgram& mesh, const Material& material) const {
  mesh.program.use();
  set_surface(mesh.surface, material);
  // Away from the surface so that it does not shade itself; leaves further, as their own plant's
  // foliage is what the map is too coarse for.
  const bool pixel_shadows = shader_for(material).pixel_shadows;
  const auto along_normal = static_cast<float>(pixel_shadows ? 2 * shadow_map_.texel() : 0);
  const Eigen::Vector4f leaf(material.translucency, material.double_sided ? 1 : 0, along_normal,
                             pixel_shadows ? 0.002f : 0.03f);
  gl.Uniform4fv(mesh.leaf, 1, leaf.data());
  if (material.texture >= 0) {
    gl.BindTexture(GL_TEXTURE_2D,
                   scene_.textures[static_cast<std::size_t>(material.texture)].get());
  }
  (material.double_sided ? gl.Disable : gl.Enable)(GL_CULL_FACE);
}

void Painter::draw_primitive(const GpuPrimitive& primitive, const DrawBatch& batch) const {
  gl.BindVertexArray(primitive.array.get());
  gl.BindBuffer(GL_ARRAY_BUFFER, instances_.get());
  bind_instances(batch.first);
  const std::size_t offset =
      sizeof(std::uint32_t) * static_cast<std::size_t>(batch.order * primitive.count);
  gl.DrawElementsInstanced(GL_TRIANGLES, primitive.count, GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(offset),
                           static_cast<GLsizei>(batch.count));
}

void Painter::draw_meshes(const DrawList& list, bool ground) const {
  for (const DrawBatch& batch : list.batches) {
    const GpuModel& model = scene_.models[static_cast<std::size_t>(batch.model)];
    const GpuLevel& level = model.levels[static_cast<std::size_t>(batch.level)];
    for (const GpuPrimitive& primitive : level.primitives) {
      const Material& material = scene_.materials[static_cast<std::size_t>(primitive.material)];
      if ((material.label == Label::kGround) != ground) continue;
      use_for(programs_.at(shader_for(material).key()), material);
      draw_primitive(primitive, batch);
    }
  }
}

void Painter::draw_sky(const View& view) const {
  sky_program_.use();
  gl.Uniform1i(sky_program_.uniform("picture"), kPictureUnit);
  // The clip space's x and y to the camera's ray of z = 1, and that into the world.
  Eigen::Matrix4d ray_from_clip = Eigen::Matrix4d::Zero();
  ray_from_clip.col(0).head<3>() = Eigen::Vector3d(1 / view.clip(0, 0), 0, 0);
  ray_from_clip.col(1).head<3>() = Eigen::Vector3d(0, 1 / view.clip(1, 1), 0);
  ray_from_clip.col(2).head<3>() =
      Eigen::Vector3d(-view.clip(0, 2) / view.clip(0, 0), -view.clip(1, 2) / view.clip(1, 1), 1);
  const Eigen::Matrix3d R_world_cam = view.world_from_cam.topLeftCorner<3, 3>();
  ray_from_clip.topRows<3>() = (R_world_cam * ray_from_clip.topRows<3>()).eval();
  set_matrix(sky_program_.uniform("ray_from_clip"), ray_from_clip);
  gl.Disable(GL_CULL_FACE);
  gl.BindTexture(GL_TEXTURE_2D, sky_.get());
  gl.BindVertexArray(no_vertices_.get());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Painter::draw_wires(const View& view) const {
  if (scene_.wires.empty()) return;
  set_view(wire_program_, view);
  const float focal_length = static_cast<float>(0.5 * (view.camera.fx + view.camera.fy));
  gl.Uniform1f(wire_program_.uniform("focal_length"), focal_length);
  gl.Disable(GL_CULL_FACE);
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC1_COLOR, GL_ONE_MINUS_SRC1_COLOR);
  for (const GpuWires& wires : scene_.wires) {
    set_surface(wire_program_.uniform("surface"),
                scene_.materials[static_cast<std::size_t>(wires.material)]);
    gl.BindVertexArray(wires.array.get());
    gl.DrawArrays(GL_TRIANGLES, 0, wires.count);
  }
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
}

void Painter::draw(const PinholeCamera& camera, const Pose& T_world_cam, double lod_scale) {
  const View view(camera, T_world_cam);
  const DrawList list = make_draw_list(scene_, camera, T_world_cam, lod_scale);
  gl.BindBuffer(GL_ARRAY_BUFFER, instances_.get());
  gl.BufferData(GL_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(list.cam_from_model.size() * sizeof(InstanceMatrix)),
                list.cam_from_model.data(), GL_STREAM_DRAW);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.DepthMask(GL_TRUE);
  gl.FrontFace(GL_CW);
  gl.Disable(GL_BLEND);
  gl.ClearColor(0, 0, 0, 0);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl.ActiveTexture(GL_TEXTURE0 + kShadowUnit);
  gl.BindTexture(GL_TEXTURE_2D, shadow_map_.texture().get());
  gl.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
  for (const auto& [key, mesh] : programs_) set_view(mesh.program, view);
  draw_meshes(list, false);
  draw_meshes(list, true);
  draw_sky(view);
  draw_wires(view);
  gl.BindVertexArray(0);
}

}  // namespace vinebench
