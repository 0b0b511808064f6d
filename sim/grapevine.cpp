// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/grapevine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/textures.h"
#include "slam/base/random.h"

namespace vinebench {
namespace {

using Eigen::Vector3f;

constexpr float kShootSpacing = 0.085f;   // m along the cordon
constexpr float kInternode = 0.072f;      // m between leaves of a shoot
constexpr float kShootStep = 0.09f;       // m between points of its path
constexpr float kBunchClearance = 0.07f;  // m between neighbouring bunches

constexpr float kLeafBelowFruit = 0.02f;  // m that leaves may hang below the lowest bunch
constexpr int kLeafOfDraw[12] = {0, 0, 1, 1, 2, 2, 3, 4, 5, 5, 3, 7};  // turned leaves are rare

class Grower {
 public:
  Grower(const WorldConfig::Vines& vines, std::uint64_t seed, int index)
      : random_(RandomStream(seed, "grapevine", static_cast<std::uint64_t>(index))),
        spacing_(static_cast<float>(vines.spacing)),
        fruit_(static_cast<float>(vines.lowest_bunch)),
        top_(static_cast<float>(vines.canopy_top)) {
    plant_.half_depth = static_cast<float>(vines.canopy_depth / 2 / kLargestPlantScale);
  }

  Grapevine grow() {
    grow_trunk();
    grow_cordon(-1);
    grow_cordon(1);
    const int shoots = std::max(2, static_cast<int>(spacing_ / kShootSpacing + 0.5f));
    for (int i = 0; i < shoots; ++i) {
      const float along = (static_cast<float>(i) + 0.5f + uniform(-0.3f, 0.3f)) / shoots - 0.5f;
      grow_shoot(0.97f * along * spacing_);
    }
    lower_one_bunch();
    return std::move(plant_);
  }

 private:
  float uniform(float low, float high) { return static_cast<float>(random_.uniform(low, high)); }
  float normal(float sigma) { return static_cast<float>(random_.normal(0, sigma)); }

  /// Crooked, thicker at foot and head, with the swellings of old wood.
  void grow_trunk() {
    constexpr int kPoints = 11;
    const float phase = uniform(0, 6.28f), sway = uniform(0.012f, 0.032f);
    const float thickness = uniform(0.020f, 0.027f);
    Tube trunk;
    for (int i = 0; i < kPoints; ++i) {
      const float t = static_cast<float>(i) / (kPoints - 1);
      const float free = std::sin(t * std::numbers::pi_v<float>);  // foot and head stay in place
      trunk.path.emplace_back(sway * free * std::sin(phase + 5 * t) + free * normal(0.004f),
                              0.7f * sway * free * std::cos(phase + 4 * t) + free * normal(0.004f),
                              -0.03f + t * (fruit_ + 0.025f));
      const float swelling = 0.45f * std::exp(-12 * t) + 0.35f * std::exp(-10 * (1 - t));
      trunk.radii.push_back(thickness * (1 + swelling + normal(0.07f)) *
                            (i + 1 == kPoints ? 0.6f : 1));
    }
    plant_.wood.push_back(std::move(trunk));
  }

  void grow_cordon(float side) {
    constexpr int kPoints = 9;
    Tube arm;
    const float length = 0.49f * spacing_;
    for (int i = 0; i < kPoints; ++i) {
      const float t = static_cast<float>(i) / (kPoints - 1);
      const float bow = 0.05f * std::exp(-9 * t);  // leaves the head from below
      arm.path.emplace_back(side * length * t, normal(0.004f),
                            fruit_ - 0.005f - bow + normal(0.005f));
      arm.radii.push_back(0.017f - 0.008f * t + std::abs(normal(0.0015f)));
    }
    plant_.wood.push_back(std::move(arm));
  }

  void grow_shoot(float x) {
    Tube cane;
    const float end = top_ - uniform(0.0f, 0.16f);
    const float room = 0.3f * plant_.half_depth;
    const float lean = normal(0.05f);
    Vector3f at(x, normal(0.003f), fruit_ - 0.004f);
    float y_drift = 0;
    while (at.z() < end) {
      cane.path.push_back(at);
      const float grown = (at.z() - fruit_) / (top_ - fruit_);
      cane.radii.push_back(0.0046f - 0.0028f * std::clamp(grown, 0.0f, 1.0f));
      y_drift = 0.6f * y_drift + normal(0.008f);
      at += Vector3f(lean * kShootStep + normal(0.007f), y_drift, kShootStep);
      at.y() = std::clamp(0.9f * at.y(), -room, room);
      at.x() = std::clamp(at.x(), -0.52f * spacing_, 0.52f * spacing_);
    }
    if (cane.path.size() < 2) return;
    grow_nodes(cane);
    plant_.canes.push_back(std::move(cane));
  }

  static Vector3f point_at(const Tube& cane, float distance) {
    for (std::size_t i = 1; i < cane.path.size(); ++i) {
      const float length = (cane.path[i] - cane.path[i - 1]).norm();
      if (distance <= length) {
        return cane.path[i - 1] + distance / length * (cane.path[i] - cane.path[i - 1]);
      }
      distance -= length;
    }
    return cane.path.back();
  }

  /// A leaf at each node, left and right in turn; bunches opposite the leaves of the lowest nodes.
  void grow_nodes(const Tube& cane) {
    const float length = cane.path.back().z() - cane.path.front().z();
    float side = random_.below(2) == 0 ? 1.0f : -1.0f;
    int node = 0;
    for (float s = uniform(0.03f, 0.07f); s < length; s += kInternode * uniform(0.85f, 1.15f)) {
      const Vector3f at = point_at(cane, s);
      const float grown = s / std::max(length, 0.2f);
      const bool fruit_zone = at.z() < fruit_ + 0.26f;
      // Growers strip about half of the leaves round the fruit.
      if (!fruit_zone || random_.uniform() < 0.5) grow_leaf(at, side, grown, 1.0f);
      if (!fruit_zone && random_.uniform() < 0.5) grow_leaf(at, -side, grown, uniform(0.5f, 0.75f));
      if (node >= 1 && node <= 3 && random_.uniform() < 0.45) grow_bunch(at, -side);
      side = -side;
      ++node;
    }
  }

  void grow_leaf(const Vector3f& node, float side, float grown, float vigour) {
    const float swing = normal(0.75f);
    const Vector3f out(std::sin(swing), side * std::cos(swing), 0);
    BladePlacement leaf;
    leaf.size = uniform(0.082f, 0.122f) * vigour * (grown > 0.75f ? 1.5f - 0.75f * grown : 1.0f);
    leaf.foot = node + uniform(0.45f, 0.95f) * leaf.size * (0.8f * out + Vector3f(0, 0, 0.45f));
    leaf.curl = uniform(0.08f, 0.32f);
    const Vector3f face =
        out * uniform(0.5f, 1.1f) + Vector3f(normal(0.25f), normal(0.15f), uniform(0.15f, 0.8f));
    const Vector3f midrib = 0.5f * out + Vector3f(normal(0.45f), 0, -uniform(0.5f, 1.0f));
    const Axes axes = axes_along(face, midrib);
    leaf.axes = {-axes.y, axes.x, axes.z};
    const bool young = grown > 0.85f || vigour < 0.6f;
    leaf.cell = leaf_cell(young ? 6 : kLeafOfDraw[random_.below(12)]);
    keep_within_canopy(leaf);
    const float outward = leaf.foot.y() / plant_.half_depth;
    leaf.shading_normal = 0.8f * Vector3f(0, outward, 0.45f).normalized();
    if (vigour > 0.9f) plant_.stalks.push_back({{node, leaf.foot}, {0.0015f, 0.0011f}});
    plant_.leaves.push_back(leaf);
  }

  /// Shifts a blade until none of its rim passes the canopy's face or hangs below its foot.
  void keep_within_canopy(BladePlacement& leaf) const {
    float low = leaf.foot.y(), high = leaf.foot.y(), bottom = leaf.foot.z();
    for (const Eigen::Vector2f& p : leaf_outline(2)) {
      const float y =
          leaf.foot.y() + leaf.size * (p.x() * leaf.axes.x.y() + p.y() * leaf.axes.y.y());
      const float sag = leaf.curl * p.squaredNorm() * leaf.axes.z.z();
      const float z = p.x() * leaf.axes.x.z() + p.y() * leaf.axes.y.z() - std::max(0.0f, sag);
      bottom = std::min(bottom, leaf.foot.z() + leaf.size * z);
      low = std::min(low, y);
      high = std::max(high, y);
    }
    leaf.foot.z() += std::max(0.0f, fruit_ - kLeafBelowFruit - bottom);
    if (high > plant_.half_depth) leaf.foot.y() -= high - plant_.half_depth;
    if (low < -plant_.half_depth) leaf.foot.y() -= low + plant_.half_depth;
  }

  void grow_bunch(const Vector3f& node, float side) {
    Bunch bunch;
    bunch.length = uniform(0.10f, 0.15f);
    bunch.radius = uniform(0.030f, 0.040f);
    const float reach = std::min(0.06f, plant_.half_depth - bunch.radius);
    bunch.top =
        node + Vector3f(normal(0.012f), side * std::max(0.0f, reach) * uniform(0.5f, 1.0f), -0.03f);
    bunch.top.z() = std::max(bunch.top.z(), fruit_ + bunch.length + uniform(0.0f, 0.04f));
    bunch.berry_seed = static_cast<std::uint64_t>(random_.below(1 << 30));
    for (const Bunch& other : plant_.bunches) {
      if ((other.top - bunch.top).norm() < kBunchClearance) return;
    }
    plant_.stalks.push_back({{node, bunch.top}, {0.0022f, 0.0018f}});
    plant_.bunches.push_back(bunch);
  }

  /// The lowest bunch hangs exactly at the height that the world asks for.
  void lower_one_bunch() {
    if (plant_.bunches.empty()) return;
    const auto bottom = [](const Bunch& bunch) { return bunch.top.z() - bunch.length; };
    const auto lowest =
        std::min_element(plant_.bunches.begin(), plant_.bunches.end(),
                         [&](const Bunch& a, const Bunch& b) { return bottom(a) < bottom(b); });
    lowest->top.z() = fruit_ + lowest->length;
  }

  RandomSequence random_;
  float spacing_, fruit_, top_;
  Grapevine plant_;
};

}  // namespace

Grapevine grow_grapevine(const WorldConfig::Vines& vines, std::uint64_t seed, int index) {
  return Grower(vines, seed, index).grow();
}

}  // namespace vinebench
