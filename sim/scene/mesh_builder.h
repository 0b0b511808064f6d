// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// A bent tube: trunk, cane, post, blade of grass.
struct Tube {
  std::vector<Eigen::Vector3f> path;  ///< m
  std::vector<float> radii;           ///< m, one for each point of the path
  float knots = 0;  ///< height of the bulges of old wood, as a share of its radius
};

/// Right-handed axes; columns of a rotation.
struct Axes {
  Eigen::Vector3f x, y, z;
};

/// Axes whose z is `direction`; x as near to `hint` as can be.
Axes axes_along(const Eigen::Vector3f& direction, const Eigen::Vector3f& hint);

/// A rectangle of a texture: u and v of its upper left and lower right corner.
struct TextureCell {
  Eigen::Vector2f from = Eigen::Vector2f::Zero();
  Eigen::Vector2f to = Eigen::Vector2f::Ones();
  Eigen::Vector2f at(float u, float v) const {
    return {from.x() + u * (to.x() - from.x()), from.y() + v * (to.y() - from.y())};
  }
};

/// A leaf blade and its pose.
struct BladePlacement {
  Eigen::Vector3f foot;            ///< m, where the stalk enters
  Axes axes;                       ///< x across, y along the midrib to the tip, z out of the face
  float size = 0.1f;               ///< m, foot to tip
  float curl = 0.2f;               ///< height of the foot above the rim, in sizes
  Eigen::Vector3f shading_normal;  ///< blended with the blade's own
  TextureCell cell;
  float lobes = 0.5f;  ///< depth of the sinuses: 0 an entire leaf, 1 cut to the veins
  std::array<std::uint8_t, 3> tint{255, 255, 255};  ///< Vertex::colour
};

/// What a berry looks like.
struct BerrySkin {
  TextureCell cell;
  std::array<std::uint8_t, 3> tint{255, 255, 255};  ///< Vertex::colour
  float light = 1;  ///< share of the ambient light at its foremost point
};

/// Outline of a vine leaf about the foot, in sizes: x across, y along the midrib, counter-clockwise
/// from the sinus at the foot. `detail`: 0 a pentagon, 1 five lobes, 2 five rounded lobes. All have
/// about the same area.
const std::vector<Eigen::Vector2f>& leaf_outline(int detail, float lobes = 0.5f);

/// Area of the outline of detail 2, in sizes squared.
float leaf_outline_area(float lobes);

/// Square of texture of a blade, in sizes: the texture's cell spans [-kLeafHalf, kLeafHalf] across
/// and [kLeafBottom, kLeafBottom + 2 kLeafHalf] along the midrib.
inline constexpr float kLeafHalf = 0.75f;
inline constexpr float kLeafBottom = -0.48f;

/// Appends to a primitive.
class MeshBuilder {
 public:
  explicit MeshBuilder(Primitive& primitive, std::uint8_t part = 0)
      : primitive_(primitive), part_(part) {}

  std::uint32_t vertex(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                       const Eigen::Vector2f& uv, float occlusion = 1);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

  /// Texture: u once around from `u_from` to `u_to`, v `v_per_metre` along. `cap` closes its end.
  void tube(const Tube& tube, int sides, float v_per_metre, bool cap, float u_from = 0,
            float u_to = 1);
  /// Three triangles from a foot to a point, for stalks.
  void spike(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius,
             const Eigen::Vector2f& uv);
  /// Triangles around the foot, rim hanging down, folded along the midrib. Detail 2 has points
  /// between foot and rim, so that the blade is curved.
  void blade(const BladePlacement& blade, int detail);
  /// The whole texture cell, for cut-out leaves: four triangles folded along the midrib, or with
  /// `cells` > 0 a curved and waved grid of so many squares a side.
  void card(const BladePlacement& blade, int cells = 0);
  /// The hemisphere that faces along `outward`.
  void dome(const Eigen::Vector3f& centre, float radius, const Eigen::Vector3f& outward, int sides,
            int rings);
  /// The hemisphere that faces along `outward`, of 18 triangles (`fine`), or a cap of 6; darker
  /// towards its back, which touches others.
  void berry(const Eigen::Vector3f& centre, float radius, const Eigen::Vector3f& outward, bool fine,
             const BerrySkin& skin);
  /// A solid of revolution about the vertical: radii at the shares `downs` of its length from the
  /// top.
  void spindle(const Eigen::Vector3f& top, float length, const std::vector<float>& downs,
               const std::vector<float>& radii, int sides, const TextureCell& cell = {});

 private:
  std::uint32_t on_card(const BladePlacement& blade, float u, float v);
  void fan(const std::vector<std::uint32_t>& rim, std::uint32_t foot);
  void curved(const std::vector<std::uint32_t>& rim, std::uint32_t foot,
              const std::array<std::uint32_t, 3>& inner);

  Primitive& primitive_;
  std::uint8_t part_ = 0;
};

}  // namespace vinebench::sim
