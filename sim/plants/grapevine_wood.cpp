// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_wood.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr float kShare = 0.485f;      // of the spacing, covered by an arm on either side
constexpr float kHeadDrop = 0.11f;    // m from the wire down to the head of a cane-pruned vine
constexpr float kSpurLength = 0.06f;  // m, of two nodes
constexpr float kCaneStep = 0.11f;    // m between points of a bare shoot's path

class Woodwork {
 public:
  Woodwork(Grapevine& plant, const PlantBrief& brief, RandomSequence& random)
      : plant_(plant),
        random_(random),
        training_(brief.vines.training),
        spacing_(static_cast<float>(brief.vines.spacing)),
        wire_(static_cast<float>(brief.vines.lowest_bunch) - 0.005f),
        girth_(static_cast<float>(brief.cultivar.vigour)),
        shoots_(std::max(2, static_cast<int>(brief.vines.shoots * brief.vines.spacing + 0.5))),
        top_(static_cast<float>(brief.vines.canopy_top)),
        dormant_(brief.stage.shoot == 0),
        pruned_(brief.vines.pruned) {}

  std::vector<Bud> build() {
    const bool cordon =
        training_ == Training::kBilateralCordon || training_ == Training::kUnilateralCordon;
    const bool both =
        training_ == Training::kBilateralCordon || training_ == Training::kDoubleGuyot;
    const float foot = both ? 0 : -kShare * spacing_;
    const float end = kShare * spacing_;
    const Vector3f head = grow_trunk(foot, wire_ - (cordon ? 0.045f : kHeadDrop), cordon);
    if (cordon) {
      if (both) grow_cordon(head, -end);
      grow_cordon(head, end);
      grow_spurs(both ? -end : foot + 0.08f, end);
    } else {
      grow_renewal_spur(head);
      const int left = shoots_ - static_cast<int>(buds_.size());
      if (both) grow_cane(head, -end, left / 2);
      grow_cane(head, end, both ? left - left / 2 : left);
    }
    if (dormant_ && random_.uniform() >= pruned_) {
      for (const Bud& bud : buds_) grow_bare_shoot(bud);
    }
    return std::move(buds_);
  }

 private:
  float uniform(float low, float high) { return static_cast<float>(random_.uniform(low, high)); }
  float normal(float sigma) { return static_cast<float>(random_.normal(0, sigma)); }

  /// A bent trunk, thicker at foot and head, with the swellings of old wood. Returns the head.
  Vector3f grow_trunk(float x, float height, bool slim_head) {
    constexpr int kPoints = 13;
    const float phase = uniform(0, 6.28f), sway = uniform(0.012f, 0.034f);
    const float thickness = girth_ * uniform(0.019f, 0.026f);
    const float lean = normal(0.012f);
    Tube trunk;
    trunk.knots = 0.16f;
    for (int i = 0; i < kPoints; ++i) {
      const float t = static_cast<float>(i) / (kPoints - 1);
      const float free = std::sin(t * std::numbers::pi_v<float>);  // foot and head are fixed
      trunk.path.emplace_back(
          x + lean * (1 - t) + sway * free * std::sin(phase + 5 * t) + free * normal(0.004f),
          0.7f * sway * free * std::cos(phase + 4 * t) + free * normal(0.004f),
          -0.04f + t * (height + 0.04f));
      const float swelling =
          0.5f * std::exp(-14 * t) + (slim_head ? 0.25f : 0.6f) * std::exp(-9 * (1 - t));
      trunk.radii.push_back(thickness * (1 - 0.12f * t + swelling + normal(0.06f)));
    }
    const Vector3f head = trunk.path.back();
    trunk.path.push_back(head + Vector3f(0, 0, 0.02f));
    trunk.radii.push_back(0.7f * trunk.radii.back());
    plant_.wood.push_back(std::move(trunk));
    return head;
  }

  /// An arm of old wood that bends from the head onto the wire.
  void grow_cordon(const Vector3f& head, float end) {
    constexpr int kPoints = 16;
    Tube arm;
    arm.knots = 0.16f;
    const float phase = uniform(0, 6.28f), sway = uniform(0.004f, 0.009f);
    for (int i = 0; i < kPoints; ++i) {
      const float t = static_cast<float>(i) / (kPoints - 1);
      const float away = std::abs(t * (end - head.x()));
      const float below = (wire_ - head.z()) * std::exp(-away / 0.06f);
      const float bend = std::sin(phase + 19 * away);
      arm.path.emplace_back(head.x() + t * (end - head.x()),
                            sway * std::sin(2 * phase + 13 * away) + normal(0.0015f),
                            wire_ - 0.010f - below + 0.6f * sway * bend + normal(0.0012f));
      arm.radii.push_back(girth_ *
                          (0.0185f - 0.006f * t + 0.0012f * bend + std::abs(normal(0.001f))));
    }
    plant_.wood.push_back(std::move(arm));
  }

  /// Short stubs of two buds on top of the cordon, evenly spaced.
  void grow_spurs(float from, float to) {
    const int spurs = (shoots_ + 1) / 2;
    for (int i = 0; i < spurs; ++i) {
      const float step = (to - from) / static_cast<float>(spurs);
      const float x = from + (static_cast<float>(i) + 0.5f + uniform(-0.2f, 0.2f)) * step;
      Vector3f lean(normal(0.18f), normal(0.10f), 1);
      lean.normalize();
      const Vector3f foot(x, normal(0.003f), wire_ - 0.004f);
      const float length = kSpurLength * uniform(0.75f, 1.2f);
      grow_stub(foot, lean, length);
      const float side = random_.below(2) == 0 ? 1.0f : -1.0f;
      buds_.push_back({foot + 0.5f * length * lean, Vector3f(0.5f * side, 0.15f * side, 1)});
      if (static_cast<int>(buds_.size()) == shoots_) continue;
      buds_.push_back({foot + 0.9f * length * lean, Vector3f(-0.35f * side, -0.1f * side, 1)});
    }
  }

  void grow_stub(const Vector3f& foot, const Vector3f& lean, float length) {
    Tube spur;
    const float radius = girth_ * uniform(0.0050f, 0.0068f);
    spur.path = {foot - 0.012f * lean, foot, foot + 0.5f * length * lean, foot + length * lean};
    spur.radii = {1.6f * radius, 1.25f * radius, radius, 0.85f * radius};
    plant_.canes.push_back(std::move(spur));
  }

  /// Two buds beside the head for next year's cane.
  void grow_renewal_spur(const Vector3f& head) {
    const Vector3f lean = Vector3f(normal(0.3f), normal(0.15f), 1).normalized();
    grow_stub(head, lean, kSpurLength);
    buds_.push_back({head + kSpurLength * lean, Vector3f(normal(0.2f), 0, 1)});
  }

  /// Last year's shoot, arched from the head and tied down along the wire.
  void grow_cane(const Vector3f& head, float end, int buds) {
    const float side = end > head.x() ? 1.0f : -1.0f, reach = std::abs(end - head.x());
    const auto point = [&](float away) {
      const float rise = 1 - std::exp(-away / 0.07f);
      const float arch = 0.055f * std::exp(-std::pow((away - 0.17f) / 0.10f, 2.0f));
      return Vector3f(head.x() + side * away, 0, head.z() + rise * (wire_ - head.z()) + arch);
    };
    Tube cane;
    constexpr int kPoints = 15;
    for (int i = 0; i < kPoints; ++i) {
      const float t = static_cast<float>(i) / (kPoints - 1);
      cane.path.push_back(point(t * reach) + Vector3f(0, normal(0.003f), normal(0.002f)));
      cane.radii.push_back(girth_ * (0.0058f - 0.0022f * t));
    }
    plant_.canes.push_back(std::move(cane));
    for (int i = 0; i < buds; ++i) {
      const float along = (static_cast<float>(i) + 0.7f + uniform(-0.25f, 0.25f)) / buds;
      const float turn = i % 2 == 0 ? 1.0f : -1.0f;
      buds_.push_back({point(0.98f * along * reach), Vector3f(normal(0.2f), 0.25f * turn, 1)});
    }
  }

  /// A shoot of the last summer without its leaves: held by the wires, its tip hangs over.
  void grow_bare_shoot(const Bud& bud) {
    const float length = std::max(0.3f, top_ - bud.at.z()) * uniform(0.45f, 1.05f);
    const float room = 0.7f * plant_.half_depth, reach = 1.04f * plant_.half_share;
    const float lean = normal(0.10f), out = normal(0.16f), thick = girth_ * uniform(0.8f, 1.25f);
    Tube cane;
    Vector3f at = bud.at, towards = bud.towards.normalized();
    for (float grown = 0; grown < length + 0.5f * kCaneStep; grown += kCaneStep) {
      const float share = std::min(1.0f, grown / length);
      cane.path.push_back(at);
      cane.radii.push_back(thick * (0.0048f - 0.0031f * share));
      if (share > 0.25f && random_.uniform() < 0.12) grow_side_shoot(at, towards);
      const bool free = at.z() > top_ - 0.05f;
      const Vector3f up(lean + normal(0.09f), out + normal(0.09f) - 1.2f * at.y(),
                        free ? -0.8f : 1.0f);
      towards = (0.5f * towards + 0.5f * up).normalized();
      at += kCaneStep * towards;
      at.y() = std::clamp(at.y(), -room, room);
      at.x() = std::clamp(at.x(), -reach, reach);
    }
    plant_.canes.push_back(std::move(cane));
  }

  /// Thin and bent, with a tendril's curl at its end.
  void grow_side_shoot(const Vector3f& foot, const Vector3f& along) {
    const float length = uniform(0.06f, 0.26f), side = random_.below(2) == 0 ? 1.0f : -1.0f;
    const Vector3f out(normal(0.5f), side * uniform(0.2f, 0.8f), uniform(-0.4f, 0.6f));
    const Vector3f middle = foot + 0.5f * length * (0.5f * along + out).normalized();
    const Vector3f tip =
        middle + 0.5f * length *
                     (along + Vector3f(normal(0.6f), 0.3f * side, normal(0.6f)) + out).normalized();
    plant_.canes.push_back({{foot, middle, tip}, {0.0016f, 0.0013f, 0.0009f}});
  }

  Grapevine& plant_;
  RandomSequence& random_;
  Training training_;
  float spacing_, wire_, girth_;
  int shoots_;
  float top_;
  bool dormant_;
  double pruned_;
  std::vector<Bud> buds_;
};

}  // namespace

std::vector<Bud> grow_old_wood(Grapevine& plant, const PlantBrief& brief, RandomSequence& random) {
  return Woodwork(plant, brief, random).build();
}

std::vector<Bud> grow_young_wood(Grapevine& plant, const PlantBrief& brief,
                                 RandomSequence& random) {
  const bool one_sided = brief.vines.training == Training::kUnilateralCordon ||
                         brief.vines.training == Training::kSingleGuyot;
  const float x = one_sided ? -kShare * static_cast<float>(brief.vines.spacing) : 0.0f;
  const float height = 0.75f * static_cast<float>(brief.vines.lowest_bunch);
  Tube stem;
  for (int i = 0; i < 7; ++i) {
    const float t = static_cast<float>(i) / 6;
    stem.path.emplace_back(x + static_cast<float>(random.normal(0, 0.004)),
                           static_cast<float>(random.normal(0, 0.004)), -0.03f + t * height);
    stem.radii.push_back(0.0075f - 0.0025f * t);
  }
  const Eigen::Vector3f head = stem.path.back();
  plant.wood.push_back(std::move(stem));
  if (random.uniform() < 0.6) {
    const float top = 0.8f * height;
    plant.shelter = Tube{{{x, 0, 0}, {x, 0, 0.5f * top}, {x, 0, top}}, {0.042f, 0.042f, 0.043f}};
  }
  return {{head, {0.05f, 0, 1}}, {head - Eigen::Vector3f(0, 0, 0.04f), {-0.3f, 0.1f, 1}}};
}

}  // namespace vinebench::sim
