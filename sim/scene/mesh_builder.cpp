// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/mesh_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vinebench::sim {
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

/// Left halves, from the sinus at the foot to the tip: angle from the tip in degrees, radius.
std::vector<Eigen::Vector2f> make_outline(int detail, float lobes) {
  const float upper = 0.90f - 0.50f * lobes, lower = 0.76f - 0.36f * lobes;  // of the sinuses
  if (detail == 0) {
    return {ray(-142, 0.52f), ray(-64, 0.80f), ray(0, 1.0f), ray(64, 0.80f), ray(142, 0.52f)};
  }
  if (detail == 1) {
    return symmetric({ray(168, 0.30f), ray(138, 0.60f), ray(98, lower), ray(62, 0.86f),
                      ray(31, upper), ray(0, 1.0f)});
  }
  return symmetric({ray(171, 0.28f), ray(146, 0.56f), ray(118, 0.64f), ray(96, lower),
                    ray(76, 0.77f), ray(58, 0.87f), ray(31, upper), ray(14, 0.88f), ray(0, 1.0f)});
}

float polygon_area(const std::vector<Eigen::Vector2f>& p) {
  float twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2f& next = p[(i + 1) % p.size()];
    twice += p[i].x() * next.y() - p[i].y() * next.x();
  }
  return std::abs(twice) / 2;
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

float leaf_outline_area(float lobes) {
  return polygon_area(leaf_outline(2, lobes));
}

const std::vector<Eigen::Vector2f>& leaf_outline(int detail, float lobes) {
  constexpr int kSteps = 20;  // resolution of depths
  using Outlines = std::array<std::array<std::vector<Eigen::Vector2f>, 3>, kSteps + 1>;
  static const Outlines kOutlines = [] {
    Outlines outlines;
    for (int step = 0; step <= kSteps; ++step) {
      auto& of_step = outlines.at(static_cast<std::size_t>(step));
      for (int d = 2; d >= 0; --d) {
        auto& outline = of_step.at(static_cast<std::size_t>(d));
        outline = make_outline(d, static_cast<float>(step) / kSteps);
        const float grow = std::sqrt(polygon_area(of_step[2]) / polygon_area(outline));
        for (Eigen::Vector2f& p : outline) p *= grow;
      }
    }
    return outlines;
  }();
  const int step = static_cast<int>(std::clamp(lobes, 0.0f, 1.0f) * kSteps + 0.5f);
  return kOutlines.at(static_cast<std::size_t>(step)).at(static_cast<std::size_t>(detail));
}

std::uint32_t MeshBuilder::vertex(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                                  const Eigen::Vector2f& uv, float occlusion) {
  primitive_.vertices.push_back({position, normal, uv, occlusion, part_});
  return static_cast<std::uint32_t>(primitive_.vertices.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshBuilder::tube(const Tube& tube, int sides, float v_per_metre, bool cap, float u_from,
                       float u_to) {
  const std::size_t n = tube.path.size();
  Eigen::Vector3f hint = Eigen::Vector3f::UnitX();
  float along = 0;
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f direction =
        tube.path[std::min(i + 1, n - 1)] - tube.path[i > 0 ? i - 1 : 0];
    const Axes axes = axes_along(direction, hint);
    hint = axes.x;  // propagated, so that the tube does not twist
    if (i > 0) along += (tube.path[i] - tube.path[i - 1]).norm();
    const auto ring = static_cast<std::uint32_t>(primitive_.vertices.size());
    for (int s = 0; s <= sides; ++s) {
      const float turn = static_cast<float>(s % sides) / sides * kTurn;
      const Eigen::Vector3f out = std::cos(turn) * axes.x + std::sin(turn) * axes.y;
      const float bulge = std::sin(2 * turn + 31 * along) + std::sin(3 * turn - 53 * along + 1);
      vertex(tube.path[i] + tube.radii[i] * (1 + tube.knots * bulge / 2) * out, out,
             {u_from + (u_to - u_from) * static_cast<float>(s) / sides, along * v_per_metre});
    }
    for (int s = 0; i > 0 && s < sides; ++s) {
      quad(previous + s, previous + s + 1, ring + s + 1, ring + s);
    }
    previous = ring;
  }
  if (!cap) return;
  const Eigen::Vector3f end = (tube.path[n - 1] - tube.path[n - 2]).normalized();
  const std::uint32_t top =
      vertex(tube.path[n - 1], end, {(u_from + u_to) / 2, along * v_per_metre});
  for (int s = 0; s < sides; ++s) triangle(top, previous + s, previous + s + 1);
}

void MeshBuilder::spike(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius,
                        const Eigen::Vector2f& uv) {
  const Axes axes = axes_along(to - from, Eigen::Vector3f::UnitZ());
  const std::uint32_t tip = vertex(to, axes.z, uv);
  std::array<std::uint32_t, 3> ring{};
  for (std::size_t s = 0; s < 3; ++s) {
    const float turn = static_cast<float>(s) / 3 * kTurn;
    const Eigen::Vector3f out = std::cos(turn) * axes.x + std::sin(turn) * axes.y;
    ring.at(s) = vertex(from + radius * out, out, uv);
  }
  for (std::size_t s = 0; s < 3; ++s) triangle(ring[s], ring[(s + 1) % 3], tip);
}

void MeshBuilder::fan(const std::vector<std::uint32_t>& rim, std::uint32_t foot) {
  for (std::size_t i = 1; i < rim.size(); ++i) triangle(foot, rim[i - 1], rim[i]);
}

/// The rim in three parts, each around one of the inner points.
void MeshBuilder::curved(const std::vector<std::uint32_t>& rim, std::uint32_t foot,
                         const std::array<std::uint32_t, 3>& inner) {
  const std::size_t n = rim.size(), left = (n - 1) * 3 / 8, right = n - 1 - left;
  const auto part = [&](std::size_t i) { return i < left ? 0u : i < right ? 1u : 2u; };
  triangle(foot, rim.front(), inner[0]);
  for (std::size_t i = 1; i < n; ++i) {
    const auto a = part(i - 1), b = part(i);
    triangle(inner.at(a), rim[i - 1], rim[i]);
    if (a == b) continue;
    triangle(inner.at(a), rim[i], inner.at(b));
    triangle(foot, inner.at(a), inner.at(b));
  }
  triangle(foot, inner[2], rim.back());
}

void MeshBuilder::blade(const BladePlacement& blade, int detail) {
  const auto add = [&](const Eigen::Vector2f& p) {
    // The rim hangs down; the halves fold up along the midrib.
    const float sag = -blade.curl * p.squaredNorm() + 0.25f * std::abs(p.x());
    const Eigen::Vector3f at =
        blade.foot +
        blade.size * (p.x() * blade.axes.x + p.y() * blade.axes.y + sag * blade.axes.z);
    const float fold = std::clamp(5 * p.x(), -1.0f, 1.0f) * 0.25f;
    const Eigen::Vector3f own = blade.axes.z + (2 * blade.curl * p.x() - fold) * blade.axes.x +
                                2 * blade.curl * p.y() * blade.axes.y;
    const Eigen::Vector3f normal = (own.normalized() + blade.shading_normal).normalized();
    const float u = std::clamp((p.x() + kLeafHalf) / (2 * kLeafHalf), 0.0f, 1.0f);
    const float v = std::clamp(1 - (p.y() - kLeafBottom) / (2 * kLeafHalf), 0.0f, 1.0f);
    const std::uint32_t added = vertex(at, normal, blade.cell.at(u, v));
    primitive_.vertices[added].colour = blade.tint;
    return added;
  };
  std::vector<std::uint32_t> rim;
  for (const Eigen::Vector2f& p : leaf_outline(detail, blade.lobes)) rim.push_back(add(p));
  if (detail == 0) {
    quad(rim[0], rim[1], rim[3], rim[4]);
    return triangle(rim[1], rim[2], rim[3]);
  }
  const std::uint32_t foot = add(Eigen::Vector2f::Zero());
  if (detail == 1) return fan(rim, foot);
  curved(rim, foot, {add(ray(-62, 0.46f)), add(ray(0, 0.52f)), add(ray(62, 0.46f))});
}

/// A point of a waved blade, from its texture's cell.
std::uint32_t MeshBuilder::on_card(const BladePlacement& blade, float u, float v) {
  constexpr float kWave = 0.045f, kWaves = 9;  // sizes; rad a size
  const float x = (2 * u - 1) * kLeafHalf, y = kLeafBottom + (1 - v) * 2 * kLeafHalf;
  const float phase = 40 * blade.size;  // another one for each leaf
  const float rim = x * x + y * y;      // flat at the foot
  const float sag = -blade.curl * rim + 0.25f * std::abs(x) +
                    kWave * rim * std::sin(kWaves * x + phase) * std::cos(kWaves * y - 2 * phase);
  const float tilt = kWave * kWaves * rim * std::cos(kWaves * x + phase);
  const float fold = std::clamp(5 * x, -1.0f, 1.0f) * 0.25f;
  const Eigen::Vector3f own = blade.axes.z + (2 * blade.curl * x - fold - tilt) * blade.axes.x +
                              2 * blade.curl * y * blade.axes.y;
  const std::uint32_t added =
      vertex(blade.foot + blade.size * (x * blade.axes.x + y * blade.axes.y + sag * blade.axes.z),
             (own.normalized() + blade.shading_normal).normalized(), blade.cell.at(u, v));
  primitive_.vertices[added].colour = blade.tint;
  return added;
}

/// Folded along the midrib, both halves hanging.
void MeshBuilder::card(const BladePlacement& blade, int cells) {
  if (cells > 0) {
    const auto first = static_cast<std::uint32_t>(primitive_.vertices.size());
    const auto side = static_cast<std::uint32_t>(cells) + 1;
    for (std::uint32_t i = 0; i < side * side; ++i) {
      on_card(blade, static_cast<float>(i % side) / static_cast<float>(cells),
              1 - static_cast<float>(i / side) / static_cast<float>(cells));
    }
    for (std::uint32_t i = 0; i + side < side * side; ++i) {
      if (i % side + 1 == side) continue;
      quad(first + i, first + i + 1, first + i + 1 + side, first + i + side);
    }
    return;
  }
  const auto add = [&](float u, float v, float fold) {
    const float across = (2 * u - 1) * kLeafHalf;
    const float along = kLeafBottom + (1 - v) * 2 * kLeafHalf;
    const float sag = -blade.curl * (across * across + along * along) + 0.25f * std::abs(across);
    const Eigen::Vector3f own = blade.axes.z - fold * blade.axes.x;
    const std::uint32_t added =
        vertex(blade.foot +
                   blade.size * (across * blade.axes.x + along * blade.axes.y + sag * blade.axes.z),
               (own.normalized() + blade.shading_normal).normalized(), blade.cell.at(u, v));
    primitive_.vertices[added].colour = blade.tint;
    return added;
  };
  const std::uint32_t foot = add(0.5f, 1, 0), tip = add(0.5f, 0, 0);
  quad(add(0, 1, -0.3f), foot, tip, add(0, 0, -0.3f));
  quad(foot, add(1, 1, 0.3f), add(1, 0, 0.3f), tip);
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

void MeshBuilder::berry(const Eigen::Vector3f& centre, float radius, const Eigen::Vector3f& outward,
                        bool fine, const BerrySkin& skin) {
  constexpr std::size_t kSpokes = 6;
  constexpr float kAround = 1.05f;  // of the ball's radius, so that the outline has its area
  constexpr float kHigh = 0.4472136f, kOut = 0.8944272f;  // positions of the two rings
  const Axes axes = axes_along(outward, Eigen::Vector3f::UnitZ());
  const auto add = [&](float size, const Eigen::Vector3f& out, float u, float v, float share) {
    const std::uint32_t added =
        vertex(centre + size * out, out, skin.cell.at(u, v), share * skin.light);
    primitive_.vertices[added].colour = skin.tint;
    return added;
  };
  const std::uint32_t pole = add(radius, axes.z, 0.5f, 0.5f, 1);
  std::array<std::uint32_t, 2 * kSpokes> ring{};
  for (std::size_t i = 0; i < (fine ? 2 : 1) * kSpokes; ++i) {
    const bool lower = i >= kSpokes;
    const float turn = (static_cast<float>(i % kSpokes) + (lower ? 0.5f : 0.0f)) / kSpokes * kTurn;
    const Eigen::Vector3f spoke = std::cos(turn) * axes.x + std::sin(turn) * axes.y;
    const Eigen::Vector3f out = kOut * spoke + (lower ? -kHigh : kHigh) * axes.z;
    const float reach = lower ? 0.5f : 0.36f;  // in the image of a berry
    ring.at(i) = add(kAround * radius, out, 0.5f + reach * std::cos(turn),
                     0.5f + reach * std::sin(turn), lower ? 0.55f : 0.88f);
  }
  for (std::size_t i = 0; i < kSpokes; ++i) {
    const std::size_t next = (i + 1) % kSpokes;
    triangle(pole, ring.at(i), ring.at(next));
    if (!fine) continue;
    triangle(ring.at(i), ring.at(kSpokes + i), ring.at(next));
    triangle(ring.at(next), ring.at(kSpokes + i), ring.at(kSpokes + next));
  }
}

void MeshBuilder::spindle(const Eigen::Vector3f& top, float length, const std::vector<float>& downs,
                          const std::vector<float>& radii, int sides, const TextureCell& cell) {
  const auto n = radii.size();
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const float down = downs[i];
    const auto ring = static_cast<std::uint32_t>(primitive_.vertices.size());
    for (int s = 0; s <= sides; ++s) {
      const float turn = static_cast<float>(s % sides) / sides * kTurn;
      const Eigen::Vector3f out(std::cos(turn), std::sin(turn), 0);
      const Eigen::Vector3f normal = (out + (0.6f - 1.4f * down) * Eigen::Vector3f::UnitZ());
      vertex(top + radii[i] * out - length * down * Eigen::Vector3f::UnitZ(), normal.normalized(),
             cell.at(static_cast<float>(s) / sides, down));
    }
    for (int s = 0; i > 0 && s < sides; ++s) {
      quad(ring + s, ring + s + 1, previous + s + 1, previous + s);
    }
    previous = ring;
  }
}

}  // namespace vinebench::sim
