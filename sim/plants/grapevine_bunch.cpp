// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_bunch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/plants/plant_textures.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kSlices = 24;

/// The bunch itself, or its wing.
struct Body {
  Vector3f top;
  float length, radius, shoulder;

  /// Half-width at `down` (0 top, 1 bottom), m: from a cylinder to a cone, rounded at both ends.
  float width(float down) const {
    const float cone = 1 + shoulder * (0.06f - 0.72f * down);
    const float head = std::min(1.0f, down / 0.2f), tail = std::min(1.0f, (1 - down) / 0.28f);
    const float rounding = std::sqrt(std::max(0.0f, 1 - (1 - head) * (1 - head))) *
                           std::sqrt(std::max(0.0f, 1 - (1 - tail) * (1 - tail)));
    return radius * cone * (0.22f + 0.78f * rounding);
  }
};

std::vector<Body> bodies(const Bunch& bunch) {
  std::vector<Body> all{{bunch.top, bunch.length, bunch.radius, bunch.shoulder}};
  if (!bunch.wing.isZero()) {
    const Vector3f aside(bunch.wing.x(), bunch.wing.y(), -0.004f);
    all.push_back({bunch.top + aside, 0.42f * bunch.length, 0.52f * bunch.radius, 0.6f});
  }
  return all;
}

/// Area of the surface down to each slice, m^2.
std::vector<float> areas(const Body& body) {
  std::vector<float> sum{0};
  for (int i = 0; i < kSlices; ++i) {
    const float down = (static_cast<float>(i) + 0.5f) / kSlices;
    sum.push_back(sum.back() + 2 * kPi * body.width(down) * body.length / kSlices);
  }
  return sum;
}

int berries_of(const Body& body, float berry_radius) {
  return std::max(
      4, static_cast<int>(0.95f * areas(body).back() / (kPi * berry_radius * berry_radius)));
}

/// Position with the share `t` of the surface above it: 0 top, 1 bottom.
float down_at(const std::vector<float>& area, float t) {
  const float wanted = t * area.back();
  std::size_t i = 1;
  while (i + 1 < area.size() && area[i] < wanted) ++i;
  const float within = (wanted - area[i - 1]) / std::max(1e-9f, area[i] - area[i - 1]);
  return (static_cast<float>(i - 1) + std::clamp(within, 0.0f, 1.0f)) / kSlices;
}

/// Berries around the body by the golden angle, evenly over its surface, the last at its bottom.
void add_berries(MeshBuilder& builder, const Body& body, const Bunch& bunch, int count,
                 const BunchDetail& detail, std::uint64_t stream) {
  RandomSequence random(RandomStream(bunch.berry_seed, "berries", stream));
  const std::vector<float> area = areas(body);
  const float larger = std::sqrt(static_cast<float>(berries_of(body, bunch.berry_radius)) / count);
  for (int i = 0; i < count; ++i) {
    const float radius = bunch.berry_radius * std::clamp(larger, 1.0f, 1.2f) *
                         static_cast<float>(random.uniform(0.86, 1.12));
    const float turn = 2.39996f * i + static_cast<float>(random.uniform(-0.35, 0.35));
    const float down = down_at(area, (static_cast<float>(i) + 0.5f) / count);
    const auto loose = static_cast<float>(random.uniform());
    const bool last = i + 1 == count;
    const Vector3f spoke(std::cos(turn), std::sin(turn), 0);
    const Vector3f outward =
        last ? Vector3f(-Vector3f::UnitZ()) : Vector3f(spoke + (0.45f - down) * Vector3f::UnitZ());
    const bool inside = outward.y() * bunch.top.y() < 0 && std::abs(outward.y()) > 0.35f;
    const bool fine = detail.fine && (last || !inside);
    // Caps touch the core, whole berries may protrude.
    const float sunk = (fine ? 0.62f + 0.5f * loose : 1.0f + 0.2f * loose) * radius;
    const float out = last ? 0.0f : std::max(0.0f, body.width(down) - sunk);
    const float depth = last ? body.length - radius
                             : std::clamp(down * body.length, radius, body.length - 1.06f * radius);
    const Vector3f centre = body.top + out * spoke - Vector3f(0, 0, depth);
    builder.berry(centre, radius, outward, fine, berry_cell(random.below(kBerryVariants)));
  }
}

/// The whole body, or the core below its berries.
void add_solid(MeshBuilder& builder, const Body& body, const BunchDetail& detail, bool core,
               float berry_radius) {
  const std::vector<float> downs =
      detail.coarse ? std::vector<float>{0, 0.35f, 1} : std::vector<float>{0, 0.1f, 0.3f, 0.72f, 1};
  const float share = core ? 0.88f : 1.0f, inset = core ? 0.5f * berry_radius : 0.0f;
  std::vector<float> radii;
  for (const float down : downs) radii.push_back(share * body.width(down));
  builder.spindle(body.top - Vector3f(0, 0, inset), body.length - 2 * inset, downs, radii,
                  detail.sides, packed_berries_cell());
}

}  // namespace

int visible_berries(const Bunch& bunch) {
  int count = 0;
  for (const Body& body : bodies(bunch)) count += berries_of(body, bunch.berry_radius);
  return count;
}

void add_bunch(Primitive& primitive, const Bunch& bunch, int part, const BunchDetail& detail) {
  MeshBuilder builder(primitive, static_cast<std::uint8_t>(std::min(part, 255)));
  const int all = visible_berries(bunch);
  const float each = detail.fine ? 13.8f : 6.0f;  // triangles of a berry, on average
  const float share = std::min(1.0f, static_cast<float>(detail.triangles) / (each * all));
  std::uint64_t stream = 0;
  for (const Body& body : bodies(bunch)) {
    add_solid(builder, body, detail, detail.triangles > 0, bunch.berry_radius);
    if (detail.triangles == 0) continue;
    const int count = std::max(
        4, static_cast<int>(share * static_cast<float>(berries_of(body, bunch.berry_radius))));
    add_berries(builder, body, bunch, count, detail, stream++);
  }
}

}  // namespace vinebench::sim
