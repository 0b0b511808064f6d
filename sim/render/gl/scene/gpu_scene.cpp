// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "sim/render/gl/scene/mip_levels.h"
#include "sim/scene/scene_check.h"

namespace vinebench::sim {
namespace {

/// Ground is seen at grazing angles, where the level that fits its depth would blur its width.
constexpr float kGroundSharpness = -0.5f;
constexpr std::size_t kSmall = 32;    // triangles; fewer are not worth an order
constexpr std::size_t kLarge = 1500;  // triangles; a thing of fewer is drawn in one order

/// The vertices and indices of all primitives, one after the other.
struct Geometry {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;

  GpuPrimitive add(const Primitive& primitive, bool ordered) {
    GpuPrimitive gpu;
    gpu.material = primitive.material;
    gpu.first_vertex = static_cast<GLint>(vertices.size());
    gpu.first_index = indices.size();
    gpu.count = static_cast<GLsizei>(primitive.indices.size());
    const std::vector<std::uint32_t> sorted =
        ordered ? sorted_indices(primitive) : primitive.indices;
    vertices.insert(vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
    indices.insert(indices.end(), sorted.begin(), sorted.end());
    return gpu;
  }
};

bool casts_shadow(const Model& model, const std::vector<Material>& materials) {
  for (const LevelOfDetail& level : model.levels) {
    for (const Primitive& primitive : level.primitives) {
      const Label label = materials[static_cast<std::size_t>(primitive.material)].label;
      if (label != Label::kGround && label != Label::kGrass) return true;
    }
  }
  return false;
}

/// A wall around the camera is far away, although its bounds contain the camera.
double hollow_radius(const Model& model, const Eigen::AlignedBox3f& bounds) {
  if (bounds.isEmpty()) return 0;
  float squared = 1e12f;
  const Eigen::Vector3f axis = bounds.center();
  for (const LevelOfDetail& level : model.levels) {
    for (const Primitive& primitive : level.primitives) {
      for (const Vertex& vertex : primitive.vertices) {
        squared = std::min(squared, (vertex.position - axis).head<2>().squaredNorm());
      }
    }
  }
  return std::sqrt(static_cast<double>(squared));
}

bool is_large(const Model& model) {
  std::size_t indices = 0;
  if (model.levels.empty()) return false;
  for (const Primitive& primitive : model.levels.front().primitives) {
    indices += primitive.indices.size();
  }
  return indices > 3 * kLarge;
}

GpuModel add_model(Geometry& geometry, const Model& model, const std::vector<Material>& materials) {
  GpuModel gpu;
  gpu.casts_shadow = casts_shadow(model, materials);
  gpu.ordered = is_large(model);
  for (const LevelOfDetail& level : model.levels) {
    GpuLevel& to = gpu.levels.emplace_back();
    to.until = level.until;
    for (const Primitive& primitive : level.primitives) {
      if (primitive.indices.empty()) continue;
      for (const Vertex& vertex : primitive.vertices) gpu.bounds.extend(vertex.position);
      to.primitives.push_back(geometry.add(primitive, gpu.ordered));
    }
  }
  gpu.hollow = hollow_radius(model, gpu.bounds);
  return gpu;
}

struct WireVertex {
  Eigen::Vector3f from;
  Eigen::Vector3f to;
  Eigen::Vector3f shape;  // end, side, radius
};

/// Cuts a wire into pieces and hands each to `take`.
template <class Take>
void cut_wire(const Wire& wire, const Take& take) {
  constexpr float kPiece = 0.25f;  // m
  const Eigen::Vector3f along = wire.to - wire.from;
  const int pieces = std::max(1, static_cast<int>(std::ceil(along.norm() / kPiece)));
  for (int i = 0; i < pieces; ++i) {
    Wire piece = wire;
    piece.from = wire.from + along * (static_cast<float>(i) / static_cast<float>(pieces));
    piece.to = wire.from + along * (static_cast<float>(i + 1) / static_cast<float>(pieces));
    take(piece);
  }
}

void append_piece(const Wire& piece, std::vector<WireVertex>& vertices) {
  constexpr std::array<std::array<float, 2>, 6> kCorners{
      {{0, -1}, {1, -1}, {1, 1}, {0, -1}, {1, 1}, {0, 1}}};
  for (const auto& [end, side] : kCorners) {
    vertices.push_back({piece.from, piece.to, {end, side, piece.radius}});
  }
}

/// Pieces by the square of ground that they hang over, west to east and south to north.
std::map<std::pair<int, int>, std::vector<Wire>> pieces_by_place(const Scene& scene, int material) {
  constexpr float kPlace = 4;  // m
  std::map<std::pair<int, int>, std::vector<Wire>> places;
  for (const Wire& wire : scene.wires) {
    if (wire.material != material) continue;
    cut_wire(wire, [&](const Wire& piece) {
      const Eigen::Vector2f at = piece.from.head<2>() / kPlace;
      places[{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))}]
          .push_back(piece);
    });
  }
  return places;
}

WireChunk make_chunk(const std::vector<Wire>& pieces, std::size_t first) {
  Eigen::AlignedBox3f box;
  WireChunk chunk;
  for (const Wire& piece : pieces) {
    box.extend(piece.from).extend(piece.to);
    chunk.thickest = std::max(chunk.thickest, static_cast<double>(piece.radius));
  }
  chunk.centre = box.center().cast<double>();
  chunk.reach = 0.5 * static_cast<double>(box.sizes().norm()) + chunk.thickest;
  chunk.first = static_cast<GLint>(first);
  chunk.count = static_cast<GLsizei>(6 * pieces.size());
  return chunk;
}

GpuWires upload_wires(const GlFunctions& gl, const Scene& scene, int material) {
  std::vector<WireVertex> vertices;
  GpuWires gpu;
  gpu.material = material;
  for (const auto& [place, pieces] : pieces_by_place(scene, material)) {
    gpu.chunks.push_back(make_chunk(pieces, vertices.size()));
    for (const Wire& piece : pieces) append_piece(piece, vertices);
  }
  if (vertices.empty()) return gpu;
  gpu.array = make_vertex_array(gl);
  gpu.vertices = make_buffer(gl, GL_ARRAY_BUFFER, vertices);
  vertex_attribute(gl, 0, 3, sizeof(WireVertex), offsetof(WireVertex, from));
  vertex_attribute(gl, 1, 3, sizeof(WireVertex), offsetof(WireVertex, to));
  vertex_attribute(gl, 2, 3, sizeof(WireVertex), offsetof(WireVertex, shape));
  gl.BindVertexArray(0);
  return gpu;
}

bool is_cutout(const Scene& scene, int texture) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [&](const Material& m) { return m.texture == texture && m.cutout; });
}

bool is_ground(const Scene& scene, int texture) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [&](const Material& m) { return m.texture == texture && m.terrain; });
}

/// Whether only things grown use it: small and rough, they do not show how they are sampled.
bool is_vegetation(const Scene& scene, int texture) {
  for (const Material& material : scene.materials) {
    if (material.texture != texture) continue;
    const bool grown = material.label == Label::kLeaf || material.label == Label::kCane ||
                       material.label == Label::kBunch || material.label == Label::kGrass ||
                       material.label == Label::kTrunk;
    if (!grown || material.terrain) return false;
  }
  return true;
}

/// The finest vertices: the rover's own cameras are within its bounds.
std::vector<Eigen::Vector3d> vertices_of(const Model& model) {
  std::vector<Eigen::Vector3d> corners;
  if (model.levels.empty()) return corners;
  for (const Primitive& primitive : model.levels.front().primitives) {
    for (const Vertex& vertex : primitive.vertices) {
      corners.push_back(vertex.position.cast<double>());
    }
  }
  return corners;
}

std::vector<Eigen::Vector3d> corners_of(const Eigen::AlignedBox3f& bounds) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8 && !bounds.isEmpty(); ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
    corners.push_back(bounds.corner(corner).cast<double>());
  }
  return corners;
}

}  // namespace

GpuInstance place(int model_index, const GpuModel& model, const Pose& T_world_model, double scale) {
  GpuInstance gpu;
  gpu.model = model_index;
  gpu.scale = scale;
  gpu.world_from_model = T_world_model.matrix();
  gpu.world_from_model.topLeftCorner<3, 3>() *= gpu.scale;
  gpu.model_from_world = T_world_model.inverse().matrix();
  gpu.model_from_world.topRows<3>() /= gpu.scale;
  if (model.bounds.isEmpty()) return gpu;
  const Eigen::Vector3d centre = model.bounds.center().cast<double>();
  gpu.centre = (gpu.world_from_model * centre.homogeneous()).head<3>();
  gpu.radius = 0.5 * gpu.scale * model.bounds.sizes().cast<double>().norm();
  return gpu;
}

int draw_order(const Eigen::Vector3d& towards_camera) {
  const bool along_x = std::abs(towards_camera.x()) > std::abs(towards_camera.y());
  if (along_x) return towards_camera.x() > 0 ? 0 : 1;
  return towards_camera.y() > 0 ? 2 : 3;
}

std::vector<std::uint32_t> sorted_indices(const Primitive& primitive) {
  constexpr int kBins = 24;
  const std::size_t triangles = primitive.indices.size() / 3;
  Eigen::AlignedBox3f bounds;
  for (const Vertex& vertex : primitive.vertices) bounds.extend(vertex.position);
  std::vector<std::uint32_t> sorted;
  sorted.reserve(primitive.indices.size() * kDrawOrders);
  for (int order = 0; order < kDrawOrders; ++order) {
    const int axis = order / 2;
    const float width = std::max(bounds.sizes()[axis], 1e-6f);
    std::array<std::vector<std::uint32_t>, kBins> bins;
    for (std::size_t t = 0; t < triangles; ++t) {
      const std::uint32_t* triangle = &primitive.indices[3 * t];
      const float x = (primitive.vertices[triangle[0]].position[axis] +
                       primitive.vertices[triangle[1]].position[axis] +
                       primitive.vertices[triangle[2]].position[axis]) /
                          3 -
                      bounds.min()[axis];
      const int bin = std::min(kBins - 1, static_cast<int>(kBins * x / width));
      const int place = triangles < kSmall ? 0 : (order % 2 == 0 ? kBins - 1 - bin : bin);
      bins[static_cast<std::size_t>(place)].insert(bins[static_cast<std::size_t>(place)].end(),
                                                   triangle, triangle + 3);
    }
    for (const auto& bin : bins) sorted.insert(sorted.end(), bin.begin(), bin.end());
  }
  return sorted;
}

GpuScene::GpuScene(const GlFunctions& functions, const Scene& scene)
    : gl(functions),
      materials(scene.materials),
      rover_model(scene.rover_model),
      light(scene.light),
      wind(scene.wind) {
  check_scene(scene);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const Texture& texture = scene.textures[i];
    const bool cutout = is_cutout(scene, static_cast<int>(i));
    const bool smooth = !is_vegetation(scene, static_cast<int>(i));
    const bool ground = is_ground(scene, static_cast<int>(i));
    const std::vector<cv::Mat> levels =
        ground ? rough_mip_levels(texture.rgba) : mip_levels(texture.rgba, cutout);
    textures.push_back(
        make_texture(gl, levels, texture.repeat, smooth, ground ? kGroundSharpness : kNoAliasing));
  }
  Geometry geometry;
  for (const Model& model : scene.models) {
    models.push_back(add_model(geometry, model, scene.materials));
  }
  for (const Instance& instance : scene.instances) {
    instances.push_back(place(instance.model, models[static_cast<std::size_t>(instance.model)],
                              instance.T_world_model, static_cast<double>(instance.scale)));
  }
  for (const Motion& motion : scene.motions) {
    GpuInstance& instance = instances[static_cast<std::size_t>(motion.instance)];
    instance.moves = true;
    const GpuModel& model = models[static_cast<std::size_t>(instance.model)];
    moving_.push_back({motion, corners_of(model.bounds)});
  }
  if (rover_model >= 0) {
    rover_hull_ = vertices_of(scene.models[static_cast<std::size_t>(rover_model)]);
  }
  array_ = make_vertex_array(gl);
  vertices_ = make_buffer(gl, GL_ARRAY_BUFFER, geometry.vertices);
  vertex_attribute(gl, 0, 3, sizeof(Vertex), offsetof(Vertex, position));
  vertex_attribute(gl, 1, 3, sizeof(Vertex), offsetof(Vertex, normal));
  vertex_attribute(gl, 2, 2, sizeof(Vertex), offsetof(Vertex, uv));
  vertex_attribute(gl, 3, 1, sizeof(Vertex), offsetof(Vertex, occlusion));
  byte_attribute(gl, 8, sizeof(Vertex), offsetof(Vertex, part));
  colour_attribute(gl, 9, sizeof(Vertex), offsetof(Vertex, colour));
  indices_ = make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, geometry.indices);
  rows_ = make_buffer(gl, GL_ARRAY_BUFFER, nullptr, 0);
  for (GLuint row = 0; row < 3; ++row) {
    vertex_attribute(gl, 4 + row, 4, sizeof(InstanceRow), row * 4 * sizeof(float), 1);
  }
  integer_attribute(gl, 7, sizeof(InstanceRow), offsetof(InstanceRow, number), 1);
  gl.BindVertexArray(0);
  for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i) {
    GpuWires pieces = upload_wires(gl, scene, i);
    if (!pieces.chunks.empty()) wires.push_back(std::move(pieces));
  }
}

std::vector<Mover> GpuScene::movers(double time, const std::optional<Pose>& T_world_rover) const {
  const Stamp stamp = from_seconds(time);
  std::vector<Mover> movers;
  for (const Moving& moving : moving_) {
    const auto index = static_cast<std::size_t>(moving.motion.instance);
    const GpuInstance& still = instances[index];
    const GpuModel& model = models[static_cast<std::size_t>(still.model)];
    const Pose pose = moving.motion.T_world_model(stamp);
    movers.push_back({index, pose, place(still.model, model, pose, still.scale), &moving.hull});
  }
  if (T_world_rover && rover_model >= 0) {
    const GpuModel& model = models[static_cast<std::size_t>(rover_model)];
    movers.push_back({instances.size(), *T_world_rover,
                      place(rover_model, model, *T_world_rover, 1), &rover_hull_});
  }
  return movers;
}

void GpuScene::set_instances(const std::vector<InstanceRow>& rows) const {
  gl.BindVertexArray(array_.get());
  gl.BindBuffer(GL_ARRAY_BUFFER, rows_.get());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rows.size() * sizeof(InstanceRow)),
                rows.data(), GL_STREAM_DRAW);
}

void GpuScene::draw(const GpuPrimitive& primitive, int order, std::size_t first,
                    std::size_t count) const {
  const std::size_t index =
      primitive.first_index + static_cast<std::size_t>(order) * primitive.count;
  gl.DrawElementsInstancedBaseVertexBaseInstance(
      GL_TRIANGLES, primitive.count, GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(index * sizeof(std::uint32_t)), static_cast<GLsizei>(count),
      primitive.first_vertex, static_cast<GLuint>(first));
}

}  // namespace vinebench::sim
