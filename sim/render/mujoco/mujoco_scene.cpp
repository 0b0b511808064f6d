// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/mujoco/mujoco_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <span>
#include <string>

#include "core/util/error.h"
#include "core/util/warning.h"

namespace vinebench::sim {
namespace {

using Bytes = std::vector<char>;
using Text = std::back_insert_iterator<std::string>;

constexpr int kRoverNumber = -2;      // in place of an instance's index; a wire has -1
constexpr double kRoverDistance = 0;  // m, whose level of detail is drawn
constexpr double kOutOfSight = -1e5;  // m below ground, beyond the far plane

template <class T>
void append(Bytes& bytes, const T* values, std::size_t count) {
  const char* first = reinterpret_cast<const char*>(values);
  bytes.insert(bytes.end(), first, first + count * sizeof(T));
}

/// Adds a file to those in memory, as MuJoCo 2 and as later versions do it.
#ifdef mjMAXVFS
void add_file(mjVFS& files, const std::string& name, const Bytes& bytes) {
  if (mj_makeEmptyFileVFS(&files, name.c_str(), static_cast<int>(bytes.size())) != 0) {
    fail("MuJoCo takes at most {} files, no more {}", mjMAXVFS, name);
  }
  std::memcpy(files.filedata[files.nfile - 1], bytes.data(), bytes.size());
}
#else
void add_file(mjVFS& files, const std::string& name, const Bytes& bytes) {
  if (mj_addBufferVFS(&files, name.c_str(), bytes.data(), static_cast<int>(bytes.size())) != 0) {
    fail("MuJoCo does not take the file {}", name);
  }
}
#endif

/// Files in memory, from which MuJoCo loads its model.
class Files {
 public:
  Files() { mj_defaultVFS(files_.get()); }
  void add(const std::string& name, const Bytes& bytes) { add_file(*files_, name, bytes); }
  const mjVFS* get() const { return files_.get(); }

 private:
  struct Free {
    void operator()(mjVFS* files) const {
      mj_deleteVFS(files);
      delete files;
    }
  };
  std::unique_ptr<mjVFS, Free> files_{new mjVFS};
};

/// Two triangles of a millimetre, which give a flat mesh the volume that MuJoCo asks for.
void append_speck(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const Vertex corner = vertices.front();
  for (const Eigen::Vector3f& offset :
       {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1e-3f, 0, 0), Eigen::Vector3f(0, 1e-3f, 0),
        Eigen::Vector3f(0, 0, 1e-3f)}) {
    vertices.push_back(corner);
    vertices.back().position += offset;
  }
  for (const std::uint32_t i : {0U, 1U, 3U, 0U, 2U, 3U}) indices.push_back(first + i);
}

/// MuJoCo's binary mesh format: four counts, then vertices, normals, texture places and faces.
Bytes msh_file(const Primitive& primitive) {
  std::vector<Vertex> vertices = primitive.vertices;
  std::vector<std::uint32_t> indices = primitive.indices;
  append_speck(vertices, indices);
  const auto count = static_cast<std::int32_t>(vertices.size());
  const std::array<std::int32_t, 4> header{count, count, count,
                                           static_cast<std::int32_t>(indices.size() / 3)};
  Bytes file;
  append(file, header.data(), header.size());
  for (const Vertex& vertex : vertices) append(file, vertex.position.data(), 3);
  for (const Vertex& vertex : vertices) append(file, vertex.normal.data(), 3);
  for (const Vertex& vertex : vertices) append(file, vertex.uv.data(), 2);
  append(file, indices.data(), indices.size());
  return file;
}

/// MuJoCo's own format of images: width, height, RGB.
Bytes texture_file(const Texture& texture) {
  const std::array<std::int32_t, 2> header{texture.rgba.cols, texture.rgba.rows};
  Bytes file;
  append(file, header.data(), header.size());
  for (int y = 0; y < texture.rgba.rows; ++y) {
    for (int x = 0; x < texture.rgba.cols; ++x) {
      append(file, texture.rgba.ptr<std::uint8_t>(y, x), 3);
    }
  }
  return file;
}

float encoded(float linear) {
  return std::pow(std::clamp(linear, 0.0f, 1.0f), 1 / 2.2f);
}

const LevelOfDetail* level_at(const Model& model, double distance) {
  for (const LevelOfDetail& level : model.levels) {
    if (distance < level.until) return level.primitives.empty() ? nullptr : &level;
  }
  return nullptr;
}

bool drawable(const Primitive& primitive) {
  return primitive.vertices.size() > 2 && primitive.indices.size() > 2;
}

void write_materials(Text text, Files& files, const Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    files.add(fmt::format("t{}.tex", i), texture_file(scene.textures[i]));
    fmt::format_to(text, "<texture name=\"t{}\" type=\"2d\" file=\"t{}.tex\"/>\n", i, i);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    if (material.vertex_colours) {
      warn(fmt::format("material '{}': the MuJoCo renderer does not draw the colours of vertices",
                       material.name));
    }
    const std::string texture =
        material.texture < 0 ? "" : fmt::format("texture=\"t{}\"", material.texture);
    fmt::format_to(text,
                   "<material name=\"a{}\" {} specular=\"0\" shininess=\"0\" rgba=\"{} {} {} 1\"/>"
                   "\n",
                   i, texture, encoded(material.colour.x()), encoded(material.colour.y()),
                   encoded(material.colour.z()));
  }
}

void write_meshes(Text text, Files& files, const Scene& scene, double distance) {
  for (std::size_t m = 0; m < scene.models.size(); ++m) {
    const bool rover = static_cast<int>(m) == scene.rover_model;
    const LevelOfDetail* level = level_at(scene.models[m], rover ? kRoverDistance : distance);
    for (std::size_t p = 0; level != nullptr && p < level->primitives.size(); ++p) {
      if (!drawable(level->primitives[p])) continue;
      files.add(fmt::format("m{}_{}.msh", m, p), msh_file(level->primitives[p]));
      fmt::format_to(text, "<mesh name=\"m{}_{}\" file=\"m{}_{}.msh\"/>\n", m, p, m, p);
    }
  }
}

/// A level's geoms, in a place and with a number of their own.
void write_geoms(Text text, std::size_t model, const LevelOfDetail& level, const Pose& at,
                 int number) {
  const Eigen::Vector3d& p = at.translation;
  const Eigen::Quaterniond& q = at.rotation;
  for (std::size_t i = 0; i < level.primitives.size(); ++i) {
    if (!drawable(level.primitives[i])) continue;
    fmt::format_to(text,
                   "<geom type=\"mesh\" mesh=\"m{}_{}\" material=\"a{}\" user=\"{}\" pos=\"{} {} "
                   "{}\" quat=\"{} {} {} {}\"/>\n",
                   model, i, level.primitives[i].material, number, p.x(), p.y(), p.z(), q.w(),
                   q.x(), q.y(), q.z());
  }
}

void write_instances(Text text, const Scene& scene, double distance) {
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto model = static_cast<std::size_t>(instance.model);
    const LevelOfDetail* level = level_at(scene.models[model], distance);
    if (level != nullptr) {
      write_geoms(text, model, *level, instance.T_world_model, static_cast<int>(i));
    }
  }
}

/// At the origin, at the level that its own cameras see.
void write_rover(Text text, const Scene& scene) {
  if (scene.rover_model < 0) return;
  const auto model = static_cast<std::size_t>(scene.rover_model);
  const LevelOfDetail* level = level_at(scene.models[model], kRoverDistance);
  if (level != nullptr) write_geoms(text, model, *level, {}, kRoverNumber);
}

void write_wires(Text text, const Scene& scene) {
  for (const Wire& wire : scene.wires) {
    fmt::format_to(
        text,
        "<geom type=\"cylinder\" material=\"a{}\" user=\"-1\" size=\"{}\" fromto=\"{} {} "
        "{} {} {} {}\"/>\n",
        wire.material, wire.radius, wire.from.x(), wire.from.y(), wire.from.z(), wire.to.x(),
        wire.to.y(), wire.to.z());
  }
}

/// The trellis, or the origin where there is none: what sunlight must cast its shadows on.
Eigen::AlignedBox3f lit_box(const Scene& scene) {
  Eigen::AlignedBox3f box(Eigen::Vector3f::Zero());
  if (!scene.wires.empty()) box.setEmpty();
  for (const Wire& wire : scene.wires) box.extend(wire.from).extend(wire.to);
  return box;
}

void write_settings(Text text, const Scene& scene) {
  const Eigen::AlignedBox3f box = lit_box(scene);
  const Eigen::Vector3f middle = box.center();
  fmt::format_to(
      text,
      "<mujoco><size nuser_geom=\"1\"/><statistic extent=\"{}\" center=\"{} {} {}\"/>"
      "<visual><quality offsamples=\"0\" shadowsize=\"2048\"/><headlight ambient=\"0.4 0.4 0.4\" "
      "diffuse=\"0 0 0\" specular=\"0 0 0\"/></visual>"
      "<default><geom contype=\"0\" conaffinity=\"0\"/></default>",
      1 + box.diagonal().norm() / 2, middle.x(), middle.y(), middle.z());
}

void write_sun(Text text, const Scene& scene) {
  constexpr float kAway = 10;  // m
  const Eigen::Vector3f at = lit_box(scene).center() + kAway * scene.light.towards_sun;
  const Eigen::Vector3f sun = -scene.light.towards_sun;
  fmt::format_to(text,
                 "<light directional=\"true\" pos=\"{} {} {}\" dir=\"{} {} {}\" "
                 "diffuse=\"0.7 0.7 0.7\" specular=\"0 0 0\"/>\n",
                 at.x(), at.y(), at.z(), sun.x(), sun.y(), sun.z());
}

std::string scene_mjcf(const Scene& scene, Files& files, double distance) {
  std::string mjcf;
  const Text text = std::back_inserter(mjcf);
  write_settings(text, scene);
  mjcf +=
      "<asset><texture type=\"skybox\" builtin=\"gradient\" rgb1=\"0.55 0.7 0.9\" "
      "rgb2=\"0.9 0.93 0.95\" width=\"256\" height=\"1536\"/>\n";
  write_materials(text, files, scene);
  write_meshes(text, files, scene, distance);
  mjcf += "</asset><worldbody>";
  write_sun(text, scene);
  write_instances(text, scene, distance);
  write_rover(text, scene);
  write_wires(text, scene);
  mjcf += "</worldbody></mujoco>\n";
  return mjcf;
}

}  // namespace

MujocoScene::MujocoScene(const Scene& scene, double level_distance) {
  Files files;
  const std::string mjcf = scene_mjcf(scene, files, level_distance);
  files.add("scene.xml", Bytes(mjcf.begin(), mjcf.end()));
  std::array<char, 1000> reason{};
  model_.reset(mj_loadXML("scene.xml", files.get(), reason.data(), reason.size()));
  if (!model_) fail("MuJoCo cannot load the scene: {}", reason.data());
  state_.reset(mj_makeData(model_.get()));
  if (!state_) fail("no memory for MuJoCo's state of the scene");
  mj_forward(model_.get(), state_.get());
  enlarge(scene);
  rover_ = find_body(kRoverNumber, {});
  for (const Motion& motion : scene.motions) {
    const Instance& instance = scene.instances[static_cast<std::size_t>(motion.instance)];
    moving_.emplace_back(motion, find_body(motion.instance, instance.T_world_model));
  }
  place_rover(std::nullopt);
}

/// MuJoCo scales meshes, not their geoms; but a scaled rotation draws a scaled geom.
void MujocoScene::enlarge(const Scene& scene) {
  for (int g = 0; g < model_->ngeom; ++g) {
    const double index = model_->geom_user[g];
    if (index < 0) continue;
    const Instance& instance = scene.instances[static_cast<std::size_t>(index)];
    const double scale = static_cast<double>(instance.scale);
    Eigen::Map<Eigen::Vector3d> at(state_->geom_xpos + 3 * g);
    const Eigen::Vector3d& foot = instance.T_world_model.translation;
    at = foot + scale * (at - foot);
    for (mjtNum& entry : std::span(state_->geom_xmat + 9 * g, 9)) entry *= scale;
  }
}

/// The geoms of that instance, which now stands there.
MujocoScene::Body MujocoScene::find_body(int number, const Pose& T_world_body) const {
  using Axes = Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>;
  const Pose T_body_world = T_world_body.inverse();
  Body body;
  for (int g = 0; g < model_->ngeom; ++g) {
    if (instance_of(g) != number) continue;
    const Eigen::Map<const Axes> R_world_geom(state_->geom_xmat + 9 * g);
    body.push_back({g, T_body_world * Eigen::Map<const Eigen::Vector3d>(state_->geom_xpos + 3 * g),
                    T_body_world.rotation.toRotationMatrix() * R_world_geom});
  }
  return body;
}

void MujocoScene::place(const Body& body, const Pose& T_world_body) {
  for (const BodyGeom& part : body) {
    Eigen::Map<Eigen::Vector3d>(state_->geom_xpos + 3 * part.geom) = T_world_body * part.at;
    Eigen::Map<Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>>(state_->geom_xmat + 9 * part.geom) =
        T_world_body.rotation.toRotationMatrix() * part.R_body_geom;
  }
}

void MujocoScene::place_rover(const std::optional<Pose>& T_world_rover) {
  const Pose hidden{Eigen::Quaterniond::Identity(), {0, 0, kOutOfSight}};
  place(rover_, T_world_rover ? *T_world_rover : hidden);
}

void MujocoScene::place_movers(double time) {
  const Stamp stamp = from_seconds(time);
  for (const auto& [motion, body] : moving_) place(body, motion.T_world_model(stamp));
}

void MujocoScene::set_image_size(int width, int height) {
  model_->vis.global.offwidth = width;
  model_->vis.global.offheight = height;
}

std::int64_t MujocoScene::triangles() const {
  std::int64_t sum = 0;
  for (int g = 0; g < model_->ngeom; ++g) {
    if (model_->geom_type[g] == mjGEOM_MESH) sum += model_->mesh_facenum[model_->geom_dataid[g]];
  }
  return sum;
}

}  // namespace vinebench::sim
