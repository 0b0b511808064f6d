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

constexpr float kLumps = 0.16f;  // of a body's width, in and out

/// The bunch itself, or its wing.
struct Body {
  Vector3f top;
  float length, radius, shoulder;
  float bend;   ///< m, of its middle along x
  float phase;  ///< rad, of its lumps

  /// Half-width at `down` (0 top, 1 bottom), m: from a cylinder to a cone, rounded at both ends.
  float width(float down) const {
    const float cone = 1 + shoulder * (0.06f - 0.72f * down);
    const float head = std::min(1.0f, down / 0.2f), tail = std::min(1.0f, (1 - down) / 0.28f);
    const float rounding = std::sqrt(std::max(0.0f, 1 - (1 - head) * (1 - head))) *
                           std::sqrt(std::max(0.0f, 1 - (1 - tail) * (1 - tail)));
    return radius * cone * (0.22f + 0.78f * rounding);
  }

  /// Side branches stand out, and leave furrows between them; mean 1, 1 at the bottom.
  float lump(float down, float turn) const {
    const float wave = std::sin(2 * turn + phase + 7 * down) * std::cos(9 * down + 2 * phase) +
                       0.6f * std::sin(3 * turn - 11 * down - phase);
    return 1 + kLumps * (1 - down) * wave;
  }

  /// A point of its axis.
  Vector3f axis(float down) const {
    return top + Vector3f(bend * std::sin(kPi * down), 0, -length * down);
  }
};

std::vector<Body> bodies(const Bunch& bunch) {
  RandomSequence random(RandomStream(bunch.berry_seed, "bodies"));
  const auto uniform = [&](double low, double high) {
    return static_cast<float>(random.uniform(low, high));
  };
  std::vector<Body> all{{bunch.top, bunch.length, bunch.radius, bunch.shoulder,
                         bunch.radius * uniform(-0.35, 0.35), uniform(0, 6.28)}};
  if (!bunch.wing.isZero()) {
    const Vector3f aside(bunch.wing.x(), bunch.wing.y(), -0.004f);
    all.push_back({bunch.top + aside, bunch.length * uniform(0.32, 0.55), 0.52f * bunch.radius,
                   0.6f, 0, uniform(0, 6.28)});
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
      4, static_cast<int>(1.25f * areas(body).back() / (kPi * berry_radius * berry_radius)));
}

/// Position with the share `t` of the surface above it: 0 top, 1 bottom.
float down_at(const std::vector<float>& area, float t) {
  const float wanted = t * area.back();
  std::size_t i = 1;
  while (i + 1 < area.size() && area[i] < wanted) ++i;
  const float within = (wanted - area[i - 1]) / std::max(1e-9f, area[i] - area[i - 1]);
  return (static_cast<float>(i - 1) + std::clamp(within, 0.0f, 1.0f)) / kSlices;
}

struct Berry {
  Vector3f centre, outward;
  float radius;
  float light;  ///< share of the ambient light that its neighbours leave it
};

/// Berries as they press on each other: thrown at the body one after the other, each of which stays
/// where it does not cut too far into another; first on the surface, then below, into the gaps.
class Packing {
 public:
  Packing(const Body& body, const Bunch& bunch, float enlarged, std::uint64_t stream)
      : body_(body),
        radius_(bunch.berry_radius * enlarged),
        apart_(0.90f - 0.16f * bunch.compactness),
        area_(areas(body)),
        random_(RandomStream(bunch.berry_seed, "berries", stream)) {}

  std::vector<Berry> pack(int count) {
    const float r = std::min(radius_, 0.4f * body_.length);
    berries_.push_back({body_.axis(1) + Vector3f(0, 0, r), -Vector3f::UnitZ(), r, 0.9f});
    constexpr int kThrows = 24;  // a berry
    const int outer = std::max(1, count * 3 / 5);
    for (int i = 0; i < kThrows * count && size() < outer; ++i) try_one(0.15f, 0.75f, 1.0f);
    for (int i = 0; i < kThrows * count && size() < count; ++i) try_one(0.9f, 1.9f, 0.7f);
    return std::move(berries_);
  }

 private:
  int size() const { return static_cast<int>(berries_.size()); }
  float uniform(float low, float high) { return static_cast<float>(random_.uniform(low, high)); }

  /// Its middle lies so many radii below the surface.
  void try_one(float least, float most, float light) {
    const float radius = radius_ * uniform(0.84f, 1.12f);
    const float down = down_at(area_, uniform(0, 1)), turn = uniform(0, 2 * kPi);
    const float sunk = uniform(least, most) * radius;
    const float out = std::max(0.0f, body_.width(down) * body_.lump(down, turn) - sunk);
    const float share = std::clamp(down, radius / body_.length, 1 - 1.1f * radius / body_.length);
    const Vector3f spoke(std::cos(turn), std::sin(turn), 0);
    const Vector3f centre = body_.axis(share) + out * spoke;
    for (const Berry& other : berries_) {
      const float apart = apart_ * (radius + other.radius);
      if ((centre - other.centre).squaredNorm() < apart * apart) return;
    }
    berries_.push_back({centre, spoke + (0.45f - down) * Vector3f::UnitZ(), radius, light});
  }

  const Body& body_;
  float radius_, apart_;
  std::vector<float> area_;
  RandomSequence random_;
  std::vector<Berry> berries_;
};

/// Ripens a little earlier or later than its bunch, and has a shade of its own.
class Skin {
 public:
  explicit Skin(const Bunch& bunch)
      : bunch_(bunch), random_(RandomStream(bunch.berry_seed, "skins")) {}

  TextureCell cell() {
    const double at = 0.5 * kBerryVariants + kBerryVariants * bunch_.ripeness +
                      random_.normal(0, 0.28 * kBerryVariants);
    return berry_cell(std::clamp(static_cast<int>(std::floor(at)), 0, kBerryVariants - 1));
  }

  std::array<std::uint8_t, 3> tint() {
    const double light = std::clamp(0.86 + random_.normal(0, 0.05), 0.7, 0.97);
    const double warm = random_.normal(0, 0.03);
    const auto byte = [](double share) {
      return static_cast<std::uint8_t>(255 * std::clamp(share, 0.0, 1.0));
    };
    return {byte(light * (1 + warm)), byte(light), byte(light * (1 - 2 * warm))};
  }

 private:
  const Bunch& bunch_;
  RandomSequence random_;
};

void add_berries(MeshBuilder& builder, const Body& body, const Bunch& bunch, int count,
                 const BunchDetail& detail, std::uint64_t stream) {
  const float fewer = std::sqrt(static_cast<float>(berries_of(body, bunch.berry_radius)) / count);
  Skin skin(bunch);
  const float enlarged = std::clamp(fewer, 1.0f, 1.5f);
  for (const Berry& berry : Packing(body, bunch, enlarged, stream).pack(count)) {
    builder.berry(berry.centre, berry.radius, berry.outward, detail.fine,
                  {skin.cell(), skin.tint(), berry.light});
  }
}

/// The whole body, or what is seen between its berries.
void add_solid(MeshBuilder& builder, const Body& body, const BunchDetail& detail, bool core,
               float berry_radius) {
  const std::vector<float> downs =
      detail.coarse ? std::vector<float>{0, 0.35f, 1} : std::vector<float>{0, 0.1f, 0.3f, 0.72f, 1};
  const float share = core ? 0.72f : 1.0f, inset = core ? 0.8f * berry_radius : 0.0f;
  std::vector<float> radii;
  for (const float down : downs) radii.push_back(share * body.width(down));
  const Vector3f bent(0.6f * body.bend, 0, 0);  // its mean
  builder.spindle(body.top + bent - Vector3f(0, 0, inset), body.length - 2 * inset, downs, radii,
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
  const float each = detail.fine ? 18.0f : 6.0f;  // triangles of a berry
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
