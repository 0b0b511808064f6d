// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plant_geometry.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vinebench {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

Eigen::Vector2f ray(float degrees_from_tip, float radius) {
  const float angle = (90 + degrees_from_tip) * kTurn / 360;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Mirrors the left half of an outline (tip last) onto the right.
std::vector<Eigen::Vector2f> symmetric(const std::vector<Eigen::Vector2f>& half) {
  std::vector<Eigen::Vector2f> outline;
  for (auto it = half.rbegin(); it != half.rend(); ++it) outline.push_back(*it);
  std::vector<Eigen::Vector2f> right;
  for (const Eigen::Vector2f& point : half) right.emplace_back(-point.x(), point.y());
  right.pop_back();
  std::vector<Eigen::Vector2f> all(right);
  all.insert(all.end(), outline.begin(), outline.end());
  return all;
}

}  // namespace

Axes axes_along(const Eigen::Vector3f& direction, const Eigen::Vector3f& hint) {
  Axes axes;
  axes.z = direction.normalized();
  Eigen::Vector3f x = hint - hint.dot(axes.z) * axes.z;
  if (x.squaredNorm() < 1e-8f) x = axes.z.unitOrthogonal();
  axes.x = x.normalized();
  axes.y = axes.z.cross(axes.x);
  return axes;
}

const std::vector<Eigen::Vector2f>& leaf_outline(int detail) {
  // Left halves, from the sinus at the foot to the tip: angle from the tip in degrees, radius.
  static const std::vector<Eigen::Vector2f> kite =
      symmetric({ray(150, 0.42f), ray(75, 0.66f), ray(0, 1.0f)});
  static const std::vector<Eigen::Vector2f> lobes =
      symmetric({ray(168, 0.30f), ray(138, 0.56f), ray(98, 0.55f), ray(62, 0.84f), ray(32, 0.66f),
                 ray(0, 1.0f)});
  static const std::vector<Eigen::Vector2f> teeth =
      symmetric({ray(171, 0.30f), ray(152, 0.52f), ray(128, 0.60f), ray(112, 0.62f), ray(96, 0.50f),
                 ray(78, 0.75f), ray(60, 0.86f), ray(45, 0.74f), ray(29, 0.58f), ray(14, 0.86f),
                 ray(0, 1.0f)});
  return detail == 0 ? kite : detail == 1 ? lobes : teeth;
}

std::uint32_t MeshBuilder::vertex(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                                  const Eigen::Vector2f& uv, float occlusion) {
  primitive_.vertices.push_back({position, normal, uv, occlusion});
  return static_cast<std::uint32_t>(primitive_.vertices.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshBuilder::tube(const Tube& tube, int sides, float v_per_metre, bool cap) {
  const std::size_t n = tube.path.size();
  Eigen::Vector3f hint = Eigen::Vector3f::UnitX();
  float along = 0;
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f direction =
        tube.path[std::min(i + 1, n - 1)] - tube.path[i > 0 ? i - 1 : 0];
    const Axes axes = axes_along(direction, hint);
    hint = axes.x;  // carried along, so that the tube does not twist
    if (i > 0) along += (tube.path[i] - tube.path[i - 1]).norm();
    const auto ring = static_cast<std::uint32_t>(primitive_.vertices.size());
    for (int s = 0; s <= sides; ++s) {
      const float turn = static_cast<float>(s % sides) / sides * kTurn;
      const Eigen::Vector3f out = std::cos(turn) * axes.x + std::sin(turn) * axes.y;
      vertex(tube.path[i] + tube.radii[i] * out, out,
             {static_cast<float>(s) / sides, along * v_per_metre});
    }
    for (int s = 0; i > 0 && s < sides; ++s) {
      quad(previous + s, previous + s + 1, ring + s + 1, ring + s);
    }
    previous = ring;
  }
  if (!cap) return;
  const Eigen::Vector3f end = (tube.path[n - 1] - tube.path[n - 2]).normalized();
  const std::uint32_t top = vertex(tube.path[n - 1], end, {0.5f, along * v_per_metre});
  for (int s = 0; s < sides; ++s) triangle(top, previous + s, previous + s + 1);
}

void MeshBuilder::blade(const BladePlacement& blade, int detail) {
  const std::vector<Eigen::Vector2f>& outline = leaf_outline(detail);
  const auto add = [&](const Eigen::Vector2f& p) {
    // The rim hangs; the halves fold up along the midrib.
    const float sag = -blade.curl * p.squaredNorm() + 0.25f * std::abs(p.x());
    const Eigen::Vector3f at =
        blade.foot +
        blade.size * (p.x() * blade.axes.x + p.y() * blade.axes.y + sag * blade.axes.z);
    const Eigen::Vector3f own =
        blade.axes.z + 0.5f * blade.curl * (p.x() * blade.axes.x + p.y() * blade.axes.y);
    const Eigen::Vector3f normal = (own.normalized() + blade.shading_normal).normalized();
    const float u = (p.x() + kLeafHalf) / (2 * kLeafHalf);
    const float v = 1 - (p.y() - kLeafBottom) / (2 * kLeafHalf);
    return vertex(at, normal, blade.cell.at(u, v));
  };
  const std::uint32_t foot = add(Eigen::Vector2f::Zero());
  std::uint32_t last = add(outline.front());
  for (std::size_t i = 1; i < outline.size(); ++i) {
    const std::uint32_t next = add(outline[i]);
    triangle(foot, last, next);
    last = next;
  }
}

void MeshBuilder::card(const BladePlacement& blade) {
  const Eigen::Vector3f normal = (blade.axes.z + blade.shading_normal).normalized();
  const auto add = [&](float u, float v) {
    const float across = (2 * u - 1) * kLeafHalf;
    const float along = kLeafBottom + (1 - v) * 2 * kLeafHalf;
    return vertex(blade.foot + blade.size * (across * blade.axes.x + along * blade.axes.y), normal,
                  blade.cell.at(u, v));
  };
  const std::uint32_t a = add(0, 1), b = add(1, 1), c = add(1, 0), d = add(0, 0);
  quad(a, b, c, d);
}

void MeshBuilder::dome(const Eigen::Vector3f& centre, float radius, const Eigen::Vector3f& outward,
                       int sides, int rings) {
  const Axes axes = axes_along(outward, Eigen::Vector3f::UnitZ());
  const std::uint32_t pole = vertex(centre + radius * axes.z, axes.z, {0.5f, 0.5f});
  std::uint32_t previous = pole;
  for (int r = 1; r <= rings; ++r) {
    const float tilt = static_cast<float>(r) / rings * 0.29f * kTurn;  // a little past the equator
    const auto ring = static_cast<std::uint32_t>(primitive_.vertices.size());
    for (int s = 0; s < sides; ++s) {
      const float turn = (s + 0.5f * (r % 2)) / sides * kTurn;
      const Eigen::Vector2f spoke(std::cos(turn), std::sin(turn));
      const Eigen::Vector3f out =
          std::cos(tilt) * axes.z + std::sin(tilt) * (spoke.x() * axes.x + spoke.y() * axes.y);
      vertex(centre + radius * out, out,
             Eigen::Vector2f(0.5f, 0.5f) + 0.48f * static_cast<float>(r) / rings * spoke);
    }
    for (int s = 0; s < sides; ++s) {
      const auto a = static_cast<std::uint32_t>(s), b = static_cast<std::uint32_t>((s + 1) % sides);
      if (r == 1) {
        triangle(pole, ring + a, ring + b);
      } else {
        quad(previous + a, ring + a, ring + b, previous + b);
      }
    }
    previous = ring;
  }
}

void MeshBuilder::spindle(const Eigen::Vector3f& top, float length, const std::vector<float>& radii,
                          int sides, float u_repeat) {
  const auto n = radii.size();
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const float down = static_cast<float>(i) / static_cast<float>(n - 1);
    const auto ring = static_cast<std::uint32_t>(primitive_.vertices.size());
    for (int s = 0; s <= sides; ++s) {
      const float turn = static_cast<float>(s % sides) / sides * kTurn;
      const Eigen::Vector3f out(std::cos(turn), std::sin(turn), 0);
      const Eigen::Vector3f normal = (out + (0.6f - 1.4f * down) * Eigen::Vector3f::UnitZ());
      vertex(top + radii[i] * out - length * down * Eigen::Vector3f::UnitZ(), normal.normalized(),
             {u_repeat * s / sides, down});
    }
    for (int s = 0; i > 0 && s < sides; ++s) {
      quad(ring + s, ring + s + 1, previous + s + 1, previous + s);
    }
    previous = ring;
  }
}

}  // namespace vinebench
