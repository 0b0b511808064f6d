// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/time.h"
#include "core/truth/labels.h"

namespace vinebench::sim {

/// An RGBA image on a surface: CV_8UC4, sRGB, first row at v = 0 (glTF's convention).
struct Texture {
  std::string name;
  cv::Mat rgba;
  bool repeat = true;  ///< otherwise clamped to its edge
};

struct Material {
  std::string name;
  Label label = Label::kGround;
  Eigen::Vector3f colour = Eigen::Vector3f::Ones();  ///< linear RGB, multiplies the texture
  int texture = -1;                                  ///< index into Scene::textures, -1 for none
  bool cutout = false;  ///< pixels with alpha below one half are transparent
  bool double_sided = false;
  float translucency = 0;       ///< share of the sunlight transmitted by a leaf, 0 to 1
  bool terrain = false;         ///< the ground: its shadows come from a top-down light map
  bool vertex_colours = false;  ///< Vertex::colour multiplies the colour too
};

struct Vertex {
  Eigen::Vector3f position;  ///< m, model frame (z up)
  Eigen::Vector3f normal;
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  float occlusion = 1;    ///< baked share of the ambient light, 0 to 1
  std::uint8_t part = 0;  ///< within its object: 0 the whole, from 1 on a bunch of a plant
  /// RGB to the power 1 / 2.2, as the shaders add up light.
  std::array<std::uint8_t, 3> colour{255, 255, 255};
};
static_assert(sizeof(Vertex) == 40, "vertices are compared and uploaded as they lie in memory");

/// Triangles (counter-clockwise from the front) of one material.
struct Primitive {
  int material = 0;  ///< index into Scene::materials
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

inline constexpr double kLevelFocalLength = 1100;  ///< px

struct LevelOfDetail {
  /// m from a camera of kLevelFocalLength; the next level is drawn beyond. Longer lenses see the
  /// finer level from further away.
  double until = 1e9;
  std::vector<Primitive> primitives;
};

/// A model with any number of instances in the world. Finest level first.
struct Model {
  std::string name;
  std::vector<LevelOfDetail> levels;
  Eigen::AlignedBox3f bounds;  ///< of the finest level
  Thing thing = Thing::kNone;  ///< kNone: that of its first material's label
};

struct Instance {
  int model = 0;       ///< index into Scene::models
  Pose T_world_model;  ///< at t = 0 where it moves
  float scale = 1;
  int id = 0;  ///< stable number of this object: a plant's index in its world
};

/// An instance that moves.
struct Motion {
  int instance = 0;                          ///< index into Scene::instances
  std::function<Pose(Stamp)> T_world_model;  ///< of time alone
};

/// A straight wire, drawn as a strip that faces the camera.
struct Wire {
  Eigen::Vector3f from;
  Eigen::Vector3f to;
  float radius = 0.0012f;  ///< m
  int material = 0;
};

/// Light of the day; colours are linear RGB, 1 is white at the camera's nominal exposure.
struct Light {
  Eigen::Vector3f towards_sun = Eigen::Vector3f::UnitZ();  ///< unit, world frame
  Eigen::Vector3f sun = Eigen::Vector3f::Constant(1.0f);
  Eigen::Vector3f sky = Eigen::Vector3f(0.45f, 0.5f, 0.6f);       ///< ambient from above
  Eigen::Vector3f bounce = Eigen::Vector3f(0.18f, 0.16f, 0.13f);  ///< ambient from below
  float overcast = 0;                                             ///< cloud cover, 0 to 1
  float haze = 0;                                                 ///< extinction of the air, 1/m
  float glare = 1;  ///< strength of the lens's scatter of a sun in the image
};

/// The wind that moves leaves, canes and bunches.
struct Wind {
  float speed = 0;                                     ///< m/s at the canopy; 0 is still air
  Eigen::Vector2f towards = Eigen::Vector2f::UnitX();  ///< unit, world frame
  std::uint64_t seed = 0;                              ///< of its gusts
};

/// The scene for rendering, in the world frame. Immutable once built.
struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Model> models;
  std::vector<Instance> instances;
  std::vector<Motion> motions;  ///< of the instances that do not keep still
  int rover_model = -1;  ///< index into models of the rover posed by RenderRequest; -1 for none
  std::vector<Wire> wires;
  Light light;
  Wind wind;
  std::uint64_t seed = 0;  ///< for procedural content of the renderer, such as clouds
  bool painted = true;     ///< else large textures are one grey texel: it is listed, not drawn
};

/// What `paint` makes where the scene is painted, else one grey texel of that name.
template <class Paint>
Texture painted_texture(const Scene& scene, const char* name, const Paint& paint) {
  if (scene.painted) return paint();
  return {name, cv::Mat(1, 1, CV_8UC4, cv::Scalar(128, 128, 128, 255)), true};
}

}  // namespace vinebench::sim
