// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/rover_asset.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/util/error.h"
#include "sim/rover/mjcf_check.h"
#include "sim/scene/block_mesh.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr int kHiddenGroup = 3;  // as in MuJoCo's viewer, this and higher groups are not shown

struct FreeMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* state) const { mj_deleteData(state); }
};

/// A point of a profile of revolution about z, with its normal: r and z.
struct ProfilePoint {
  float r, z, normal_r, normal_z;
};

/// Level of detail of round shapes: rings and sides of an ellipsoid, sides of the others.
struct RoverDetail {
  double until;  ///< m
  int rings, roller_sides, sides;
};

constexpr std::array<RoverDetail, 2> kDetails{{{4, 5, 7, 20}, {1e9, 3, 5, 10}}};

/// A geom in the body's frame.
struct Geom {
  int type = mjGEOM_BOX;
  int mesh = -1;
  Vector3f size;  // m, as MJCF's `size`
  Eigen::Matrix3f R_body_geom;
  Vector3f p_body;
};

/// Share of the ambient light, which the chassis and the ground reduce at low points.
float occlusion_at(const Vector3f& p_body) {
  return std::clamp(0.5f + 1.5f * p_body.z(), 0.5f, 1.0f);
}

class GeomBuilder {
 public:
  GeomBuilder(MeshBuilder& builder, const RoverDetail& detail, const mjModel& model,
              const Geom& geom)
      : builder_(builder), detail_(detail), model_(model), geom_(geom) {}

  void build() {
    const Vector3f& s = geom_.size;
    switch (geom_.type) {
      case mjGEOM_BOX:
        return box();
      case mjGEOM_SPHERE:
        return round({s.x(), s.x(), s.x()}, 0, detail_.sides / 2, detail_.sides);
      case mjGEOM_ELLIPSOID:
        return round(s, 0, detail_.rings, detail_.roller_sides);
      case mjGEOM_CAPSULE:
        return round({s.x(), s.x(), s.x()}, s.y(), 6, detail_.sides);
      case mjGEOM_CYLINDER:
        return cylinder(s.x(), s.y(), detail_.sides);
      case mjGEOM_MESH:
        return mesh();
      default:
        return;
    }
  }

 private:
  std::uint32_t vertex(const Vector3f& p, const Vector3f& normal) {
    const Vector3f p_body = geom_.R_body_geom * p + geom_.p_body;
    return builder_.vertex(p_body, geom_.R_body_geom * normal, {0, 0}, occlusion_at(p_body));
  }

  void face(const Vector3f& middle, const Vector3f& right, const Vector3f& up) {
    const Vector3f n = right.cross(up).normalized();
    builder_.quad(vertex(middle - right - up, n), vertex(middle + right - up, n),
                  vertex(middle + right + up, n), vertex(middle - right + up, n));
  }

  void box() {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3f out = geom_.size[axis] * Vector3f::Unit(axis);
      const Vector3f right = geom_.size[(axis + 1) % 3] * Vector3f::Unit((axis + 1) % 3);
      const Vector3f up = geom_.size[(axis + 2) % 3] * Vector3f::Unit((axis + 2) % 3);
      face(out, right, up);
      face(-out, up, right);
    }
  }

  /// Revolves the profile, from low to high, about z, then scales it.
  void revolve(const std::vector<ProfilePoint>& profile, int sides, const Vector3f& scale) {
    std::vector<std::uint32_t> last, ring;
    float last_r = 0;
    for (const ProfilePoint& point : profile) {
      ring.clear();
      for (int i = 0; i < sides; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / sides;
        const Vector3f along(std::cos(angle), std::sin(angle), 0);
        const Vector3f p = point.r * along + point.z * Vector3f::UnitZ();
        const Vector3f n = point.normal_r * along + point.normal_z * Vector3f::UnitZ();
        ring.push_back(vertex(p.cwiseProduct(scale), n.cwiseQuotient(scale).normalized()));
      }
      for (std::size_t i = 0; i < last.size(); ++i) {
        const std::size_t next = (i + 1) % last.size();
        if (last_r > 0) builder_.triangle(last[i], last[next], ring[next]);
        if (point.r > 0) builder_.triangle(last[i], ring[next], ring[i]);
      }
      last = ring;
      last_r = point.r;
    }
  }

  /// An ellipsoid with these half axes; a capsule if its halves are `half_length` m off the middle.
  void round(const Vector3f& half_axes, float half_length, int rings, int sides) {
    std::vector<ProfilePoint> profile;
    const float apart = half_length / half_axes.z();
    for (int i = 0; i <= rings; ++i) {
      const float angle = std::numbers::pi_v<float> * (static_cast<float>(i) / rings - 0.5f);
      const float r = i % rings == 0 ? 0 : std::cos(angle), z = std::sin(angle);
      if (2 * i <= rings) profile.push_back({r, z - apart, r, z});
      if (2 * i > rings || (2 * i == rings && apart > 0)) profile.push_back({r, z + apart, r, z});
    }
    revolve(profile, sides, half_axes);
  }

  void cylinder(float radius, float half_length, int sides) {
    const Vector3f scale(radius, radius, half_length);
    revolve({{1, -1, 1, 0}, {1, 1, 1, 0}}, sides, scale);
    revolve({{0, -1, 0, -1}, {1, -1, 0, -1}}, sides, scale);
    revolve({{1, 1, 0, 1}, {0, 1, 0, 1}}, sides, scale);
  }

  /// Separate triangles with face normals.
  void mesh() {
    const int first = model_.mesh_faceadr[geom_.mesh];
    const float* vertices = model_.mesh_vert + 3 * model_.mesh_vertadr[geom_.mesh];
    for (int f = first; f < first + model_.mesh_facenum[geom_.mesh]; ++f) {
      std::array<Vector3f, 3> corners;
      for (int i = 0; i < 3; ++i) {
        corners[i] = Eigen::Map<const Vector3f>(vertices + 3 * model_.mesh_face[3 * f + i]);
      }
      const Vector3f n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
      if (!n.allFinite()) continue;
      const std::uint32_t a = vertex(corners[0], n), b = vertex(corners[1], n);
      builder_.triangle(a, b, vertex(corners[2], n));
    }
  }

  MeshBuilder& builder_;
  const RoverDetail& detail_;
  const mjModel& model_;
  const Geom& geom_;
};

/// The rover's model, with its geoms' poses at the joints' zero.
class RoverModel {
 public:
  explicit RoverModel(const std::filesystem::path& mjcf) {
    check_mjcf_files(mjcf);
    std::array<char, 1000> reason{};
    model_.reset(mj_loadXML(mjcf.string().c_str(), nullptr, reason.data(), reason.size()));
    if (!model_) fail("{}: is not a valid MJCF model: {}", mjcf.string(), reason.data());
    state_.reset(mj_makeData(model_.get()));
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, "chassis");
    if (joint < 0) fail("{}: expected a joint named 'chassis', found none", mjcf.string());
    body_ = model_->jnt_bodyid[joint];
    mj_kinematics(model_.get(), state_.get());
  }

  const mjModel& model() const { return *model_; }

  bool shows(int geom) const {
    int body = model_->geom_bodyid[geom];
    while (body > body_) body = model_->body_parentid[body];
    return body == body_ && model_->geom_group[geom] < kHiddenGroup && colour(geom)[3] > 0;
  }

  const float* colour(int geom) const {
    const int material = model_->geom_matid[geom];
    return material >= 0 ? model_->mat_rgba + 4 * material : model_->geom_rgba + 4 * geom;
  }

  Geom geom(int index) const {
    const auto matrix = [](const mjtNum* numbers) {
      return Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>>(numbers);
    };
    const auto vector = [](const mjtNum* numbers) {
      return Eigen::Map<const Eigen::Matrix<mjtNum, 3, 1>>(numbers);
    };
    const Eigen::Matrix3d R_body_world = matrix(state_->xmat + 9 * body_).transpose();
    const Eigen::Vector3d away =
        vector(state_->geom_xpos + 3 * index) - vector(state_->xpos + 3 * body_);
    Geom geom;
    geom.type = model_->geom_type[index];
    geom.mesh = model_->geom_dataid[index];
    geom.size = vector(model_->geom_size + 3 * index).cast<float>();
    geom.R_body_geom = (R_body_world * matrix(state_->geom_xmat + 9 * index)).cast<float>();
    geom.p_body = (R_body_world * away).cast<float>();
    return geom;
  }

 private:
  std::unique_ptr<mjModel, FreeMujoco> model_;
  std::unique_ptr<mjData, FreeMujoco> state_;
  int body_ = 0;
};

/// The asset's material of that colour (sRGB), created if missing.
int material_of(Asset& asset, const float* rgba) {
  const Vector3f colour = linear_colour({rgba[0], rgba[1], rgba[2]});
  for (std::size_t i = 0; i < asset.materials.size(); ++i) {
    if (asset.materials[i].colour == colour) return static_cast<int>(i);
  }
  const std::string name = "rover " + std::to_string(asset.materials.size());
  asset.materials.push_back(make_material(name, Label::kRover, -1));
  asset.materials.back().colour = colour;
  return static_cast<int>(asset.materials.size()) - 1;
}

void add_level(Asset& asset, const RoverModel& rover, const RoverDetail& detail) {
  LevelOfDetail& level = asset.model.levels.emplace_back();
  level.until = detail.until;
  for (int i = 0; i < rover.model().ngeom; ++i) {
    if (!rover.shows(i)) continue;
    const int material = material_of(asset, rover.colour(i));
    level.primitives.resize(asset.materials.size());
    Primitive& part = level.primitives[static_cast<std::size_t>(material)];
    part.material = material;
    MeshBuilder builder(part);
    const Geom geom = rover.geom(i);
    GeomBuilder(builder, detail, rover.model(), geom).build();
  }
}

}  // namespace

Asset rover_asset(const std::filesystem::path& mjcf) {
  const RoverModel rover(mjcf);
  Asset asset;
  asset.model.name = "rover";
  for (const RoverDetail& detail : kDetails) add_level(asset, rover, detail);
  asset.update_bounds();
  if (asset.model.bounds.isEmpty()) fail("{}: the rover has no visible geom", mjcf.string());
  return asset;
}

void add_rover(Scene& scene, const std::filesystem::path& mjcf) {
  scene.rover_model = add_asset(scene, rover_asset(mjcf));
}

}  // namespace vinebench::sim
