// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/plants/grapevine_wood.h"
#include "sim/plants/plant_textures.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr float kShootStep = 0.09f;        // m between points of a shoot's path
constexpr float kFruitZone = 0.26f;        // m above the wire
constexpr float kBunchClearance = 0.045f;  // m between neighbouring bunches' tops
constexpr int kFirstFruitNode = 1, kLastFruitNode = 4;
constexpr std::size_t kMostBunches = 255;  // range of a vertex's part
constexpr float kLeafBelowFruit = 0.02f;   // m that leaves may hang below the lowest bunch

/// A node of a shoot that may have a leaf.
struct Node {
  Vector3f at;
  float side = 1;   ///< of the row, +1 or -1
  float swing = 0;  ///< rad, of the shoot's two ranks of leaves about the vertical
  float grown = 0;  ///< 0 foot of the shoot, 1 its tip
  float size = 0;   ///< m, of the leaf
  int rank = 0;     ///< counted from the foot
};

class Grower {
 public:
  Grower(const PlantBrief& brief, std::uint64_t seed, int index)
      : brief_(brief),
        stage_(brief.stage),
        random_(RandomStream(seed, brief.young ? "young grapevine" : "grapevine",
                             static_cast<std::uint64_t>(index))),
        fruit_(static_cast<float>(brief.vines.lowest_bunch)),
        top_(static_cast<float>(brief.vines.canopy_top)),
        lobes_(static_cast<float>(brief.cultivar.leaf.lobes)) {
    plant_.half_depth = static_cast<float>(brief.vines.canopy_depth / 2 / kLargestPlantScale);
    plant_.half_share = static_cast<float>(brief.vines.spacing / 2);
    leaf_size_ =
        static_cast<float>(std::sqrt(brief.cultivar.leaf.area / leaf_outline_area(lobes_)));
  }

  Grapevine grow() {
    const std::vector<Bud> buds = brief_.young ? grow_young_wood(plant_, brief_, random_)
                                               : grow_old_wood(plant_, brief_, random_);
    if (stage_.shoot > 0) {
      for (const Bud& bud : buds) grow_shoot(bud);
    }
    if (stage_.leaf > 0) grow_leaves();
    if (stage_.bunch > 0 && !brief_.young) {
      grow_bunches();
      lower_one_bunch();
    }
    return std::move(plant_);
  }

 private:
  float uniform(float low, float high) { return static_cast<float>(random_.uniform(low, high)); }
  float normal(float sigma) { return static_cast<float>(random_.normal(0, sigma)); }

  /// Grows upwards from its bud, held near the row's plane by the wires.
  void grow_shoot(const Bud& bud) {
    const float full = std::max(0.3f, top_ - uniform(0.0f, 0.16f) - bud.at.z());
    const float length = stage_.shoot * full * (brief_.young ? uniform(0.3f, 0.55f) : 1.0f);
    const float step = std::min(kShootStep, length / 3);
    const float room = 0.3f * plant_.half_depth, reach = 1.04f * plant_.half_share;
    const auto vigour = static_cast<float>(brief_.cultivar.vigour) * (brief_.young ? 0.7f : 1.0f);
    Tube shoot;
    Vector3f at = bud.at, towards = bud.towards.normalized();
    const float lean = normal(0.05f);
    for (float grown = 0; grown < length + 0.5f * step; grown += step) {
      shoot.path.push_back(at);
      shoot.radii.push_back(vigour * (0.0046f - 0.0030f * std::min(1.0f, grown / full)) *
                            (stage_.shoot < 0.1f ? 0.6f : 1.0f));
      const Vector3f up(lean + normal(0.06f), normal(0.08f) - 1.2f * at.y(), 1);
      towards = (0.45f * towards + 0.55f * up).normalized();
      at += step * towards;
      at.y() = std::clamp(at.y(), -room, room);
      at.x() = std::clamp(at.x(), -reach, reach);
    }
    add_nodes(shoot);
    plant_.shoots.push_back(std::move(shoot));
  }

  static Vector3f point_at(const Tube& shoot, float distance) {
    for (std::size_t i = 1; i < shoot.path.size(); ++i) {
      const float length = (shoot.path[i] - shoot.path[i - 1]).norm();
      if (distance <= length) {
        return shoot.path[i - 1] + distance / length * (shoot.path[i] - shoot.path[i - 1]);
      }
      distance -= length;
    }
    return shoot.path.back();
  }

  /// Nodes are in two ranks, alternately left and right; the lowest are closer together.
  void add_nodes(const Tube& shoot) {
    float length = 0;
    for (std::size_t i = 1; i < shoot.path.size(); ++i) {
      length += (shoot.path[i] - shoot.path[i - 1]).norm();
    }
    const auto internode =
        static_cast<float>(brief_.cultivar.internode) * std::min(1.0f, 0.2f + stage_.shoot);
    Node node;
    node.side = random_.below(2) == 0 ? 1.0f : -1.0f;
    node.swing = normal(0.45f);
    for (float s = 0.5f * internode; s < length;
         s += internode * uniform(0.85f, 1.15f) * (node.rank < 3 ? 0.75f : 1.0f)) {
      node.at = point_at(shoot, s);
      node.grown = s / length;
      const float unfolded = node.grown > 0.7f ? 1 - 1.6f * (node.grown - 0.7f) : 1.0f;
      node.size = leaf_size_ * stage_.leaf * unfolded * (node.rank < 2 ? 0.8f : 1.0f);
      nodes_.push_back(node);
      node.side = -node.side;
      ++node.rank;
    }
  }

  float spread() {
    const float draw = normal(static_cast<float>(brief_.cultivar.leaf.variation) / 2);
    return std::clamp(1 + draw, 0.6f, 1.4f);
  }

  /// A leaf at each node, then those of side shoots until the canopy has its area; then what the
  /// grower takes off round the fruit, and what has fallen.
  void grow_leaves() {
    const float per_square = leaf_outline_area(lobes_);
    const bool falling = stage_.autumn > 0.5f;
    double wanted = brief_.vines.leaf_area * brief_.vines.spacing * (falling ? 1 : stage_.foliage);
    std::vector<std::pair<Node, bool>> leaves;
    for (const Node& node : nodes_) {
      leaves.emplace_back(node, false);
      leaves.back().first.size *= spread();
    }
    double area = 0;
    for (const auto& [node, side] : leaves) area += per_square * node.size * node.size;
    const bool bare = brief_.young || stage_.foliage == 0;
    while (!bare && area < wanted && leaves.size() < 4 * nodes_.size()) {
      Node node =
          nodes_.at(static_cast<std::size_t>(random_.below(static_cast<int>(nodes_.size()))));
      if (node.grown > 0.85f) continue;
      node.size *= uniform(0.62f, 0.88f);
      node.side = -node.side;
      node.swing += normal(0.4f);
      area += per_square * node.size * node.size;
      leaves.emplace_back(node, true);
    }
    const float share = bare ? 1.0f : static_cast<float>(std::min(1.0, wanted / area));
    for (const auto& [node, side] : leaves) {
      const bool fruit_zone = node.at.z() < fruit_ + kFruitZone;
      const double stripped =
          fruit_zone && !brief_.young && stage_.bunch > 0 ? brief_.vines.leaf_removal : 0.0;
      const double kept = falling ? stage_.foliage : 1.0;
      if (random_.uniform() < stripped || random_.uniform() > kept) continue;
      grow_leaf(node, std::sqrt(share), side);
    }
  }

  void grow_leaf(const Node& node, float scale, bool lateral) {
    const float swing = node.swing + normal(0.4f);
    const Vector3f out(std::sin(swing), node.side * std::cos(swing), 0);
    BladePlacement leaf;
    leaf.lobes = std::clamp(lobes_ + normal(0.08f), 0.0f, 1.0f);
    leaf.size = scale * node.size;
    const float stalk = leaf.size * uniform(0.45f, 0.95f);
    leaf.foot = node.at + stalk * (0.8f * out + Vector3f(0, 0, 0.45f));
    leaf.curl = uniform(0.06f, 0.30f) + 0.25f * stage_.autumn * uniform(0, 1);
    const Vector3f face =
        out * uniform(0.5f, 1.1f) + Vector3f(normal(0.25f), normal(0.15f), uniform(0.15f, 0.8f));
    const Vector3f midrib = 0.5f * out + Vector3f(normal(0.45f), 0, -uniform(0.5f, 1.0f));
    const Axes axes = axes_along(face, midrib);
    leaf.axes = {-axes.y, axes.x, axes.z};
    leaf.cell = leaf_cell(variant(node, lateral), random_.below(kLeafPrints));
    if (random_.below(2) == 0) std::swap(leaf.cell.from.x(), leaf.cell.to.x());  // mirrored
    leaf.tint = own_colour();
    keep_within_canopy(leaf);
    const float outward = leaf.foot.y() / plant_.half_depth;
    leaf.shading_normal = 0.55f * Vector3f(0, outward, 0.45f).normalized();
    plant_.petioles.push_back({node.at, leaf.foot, lateral ? 0.0011f : 0.0016f});
    plant_.leaves.push_back(leaf);
  }

  /// No two leaves are of one green: some are brighter, some more yellow.
  std::array<std::uint8_t, 3> own_colour() {
    const float light = std::clamp(0.80f + normal(0.10f), 0.5f, 0.95f);
    const float yellow = std::clamp(normal(0.6f), -1.0f, 1.5f);
    const auto byte = [](float share) {
      return static_cast<std::uint8_t>(255 * std::clamp(share, 0.0f, 1.0f));
    };
    return {byte(light * (1 + 0.10f * yellow)), byte(light * (1 + 0.03f * yellow)),
            byte(light * (1 - 0.14f * yellow))};
  }

  /// Which of the atlas' leaves: 0 to 3 in their prime, 4 and 5 old, 6 young, 7 turned.
  int variant(const Node& node, bool lateral) {
    const float turned = std::clamp(stage_.autumn * (1.3f - 0.7f * node.grown), 0.0f, 1.0f);
    if (random_.uniform() < turned) return stage_.autumn > 0.5f ? 4 + random_.below(4) : 7;
    if (stage_.autumn > 0.5f) return random_.below(4);
    if (node.grown > 0.88f || stage_.shoot < 0.5f) return 6;
    if (lateral) return random_.below(3);
    return random_.below(stage_.autumn > 0 && node.rank < 5 ? 6 : 4);
  }

  /// Shifts a blade until none of its rim passes the canopy's face or hangs below its foot.
  void keep_within_canopy(BladePlacement& leaf) const {
    float low = leaf.foot.y(), high = leaf.foot.y(), bottom = leaf.foot.z();
    for (const Eigen::Vector2f& p : leaf_outline(2, leaf.lobes)) {
      const float y =
          leaf.foot.y() + leaf.size * (p.x() * leaf.axes.x.y() + p.y() * leaf.axes.y.y());
      const float sag = leaf.curl * p.squaredNorm() * leaf.axes.z.z();
      const float z = p.x() * leaf.axes.x.z() + p.y() * leaf.axes.y.z() - std::max(0.0f, sag);
      bottom = std::min(bottom, leaf.foot.z() + leaf.size * z);
      low = std::min(low, y);
      high = std::max(high, y);
    }
    if (!brief_.young) leaf.foot.z() += std::max(0.0f, fruit_ - kLeafBelowFruit - bottom);
    if (high > plant_.half_depth) leaf.foot.y() -= high - plant_.half_depth;
    if (low < -plant_.half_depth) leaf.foot.y() -= low + plant_.half_depth;
  }

  /// Opposite the leaves of the lowest nodes, so many as a shoot bears on average; tendrils higher.
  void grow_bunches() {
    const double wanted = brief_.vines.bunches * static_cast<double>(plant_.shoots.size());
    std::size_t fruitful = 0;
    for (const Node& node : nodes_) fruitful += is_fruitful(node) ? 1 : 0;
    for (int round = 0; round < 3; ++round) {
      for (const Node& node : nodes_) {
        const double left = wanted - static_cast<double>(plant_.bunches.size());
        if (!is_fruitful(node) || left < 0.5) continue;
        if (random_.uniform() < 1.4 * left / static_cast<double>(fruitful)) grow_bunch(node);
      }
    }
    for (const Node& node : nodes_) {
      if (node.rank > 5 && node.rank % 3 != 0 && random_.uniform() < 0.18) grow_tendril(node);
    }
  }

  static bool is_fruitful(const Node& node) {
    return node.rank >= kFirstFruitNode && node.rank <= kLastFruitNode;
  }

  void grow_bunch(const Node& node) {
    const Cultivar::Bunch& look = brief_.cultivar.bunch;
    const float size = std::clamp(1 + normal(0.13f), 0.65f, 1.35f);
    Bunch bunch;
    bunch.length = static_cast<float>(look.length) * size * stage_.bunch;
    bunch.radius = static_cast<float>(look.width) / 2 * std::sqrt(size) * stage_.bunch_width();
    bunch.berry_radius = static_cast<float>(brief_.cultivar.berry.diameter) / 2 * stage_.berry;
    bunch.shoulder =
        static_cast<float>(std::clamp(look.shoulder + random_.normal(0, 0.12), 0.0, 1.0));
    const float side = -node.side;
    const float reach = std::max(0.0f, std::min(0.07f, plant_.half_depth - bunch.radius));
    bunch.top = node.at + Vector3f(normal(0.015f), side * reach * uniform(0.45f, 1.0f), -0.03f);
    bunch.top.z() = std::max(bunch.top.z(), fruit_ + bunch.length + uniform(0.0f, 0.05f));
    bunch.compactness = static_cast<float>(look.compactness);
    bunch.ripeness = normal(0.12f);
    bunch.berry_seed = static_cast<std::uint64_t>(random_.below(1 << 30));
    if (random_.uniform() < 0.25 + 0.5 * bunch.shoulder) {
      bunch.wing = {(random_.below(2) == 0 ? 1.0f : -1.0f) * 0.85f * bunch.radius, 0.0f};
    }
    const float clearance = std::max(kBunchClearance, bunch.radius);
    for (const Bunch& other : plant_.bunches) {
      if ((other.top - bunch.top).norm() < clearance) return;
    }
    if (plant_.bunches.size() == kMostBunches) return;
    const Vector3f knee = 0.5f * (node.at + bunch.top) + Vector3f(0, 0.2f * side * reach, 0.012f);
    plant_.stalks.push_back(
        {{node.at, knee, bunch.top - Vector3f(0, 0, 0.01f)}, {0.0024f, 0.0022f, 0.002f}});
    plant_.bunches.push_back(bunch);
  }

  void grow_tendril(const Node& node) {
    Tube tendril;
    Vector3f at = node.at, towards = Vector3f(normal(0.6f), -0.6f * node.side, 0.6f).normalized();
    for (int i = 0; i < 5; ++i) {
      tendril.path.push_back(at);
      tendril.radii.push_back(0.0011f - 0.0002f * static_cast<float>(i));
      at += 0.028f * towards;
      at.y() = std::clamp(at.y(), -plant_.half_depth, plant_.half_depth);
      towards = (towards + Vector3f(normal(0.5f), normal(0.3f), -0.1f)).normalized();
    }
    plant_.stalks.push_back(std::move(tendril));
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

  const PlantBrief& brief_;
  const GrowthStage& stage_;
  RandomSequence random_;
  float fruit_, top_, lobes_;
  float leaf_size_ = 0.09f;
  std::vector<Node> nodes_;
  Grapevine plant_;
};

}  // namespace

Grapevine grow_grapevine(const PlantBrief& brief, std::uint64_t seed, int index) {
  return Grower(brief, seed, index).grow();
}

double leaf_area(const Grapevine& plant) {
  double area = 0;
  for (const BladePlacement& leaf : plant.leaves) {
    area += static_cast<double>(leaf_outline_area(leaf.lobes) * leaf.size * leaf.size);
  }
  return area;
}

}  // namespace vinebench::sim
