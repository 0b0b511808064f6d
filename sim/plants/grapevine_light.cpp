// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr float kCell = 0.05f;  // m
const std::array<Vector3f, 7> kDirections{Vector3f(0, 0, 1),         Vector3f(0, 0.8f, 0.6f),
                                          Vector3f(0, -0.8f, 0.6f),  Vector3f(0.8f, 0, 0.6f),
                                          Vector3f(-0.8f, 0, 0.6f),  Vector3f(0, 0.98f, -0.2f),
                                          Vector3f(0, -0.98f, -0.2f)};

}  // namespace

CanopyLight::CanopyLight(const std::vector<BladePlacement>& leaves) {
  if (leaves.empty()) return;
  for (const BladePlacement& leaf : leaves) box_.extend(leaf.foot);
  box_.min().array() -= 0.1f;
  box_.max().array() += 0.1f;
  size_ = (box_.sizes() / kCell).array().ceil().cast<int>();
  density_.assign(static_cast<std::size_t>(size_.prod()), 0);
  for (const BladePlacement& leaf : leaves) {
    const Vector3f middle = leaf.foot + 0.4f * leaf.size * leaf.axes.y;
    constexpr float kAreaOfSquare = 1.3f, kSplat = 2.0f;  // spread over the neighbours
    for (const float dx : {-0.02f, 0.02f}) {
      for (const float dz : {-0.02f, 0.02f}) {
        if (float* cell = find(middle + Vector3f(dx, 0, dz))) {
          *cell += kAreaOfSquare / kSplat * leaf.size * leaf.size / 4 / (kCell * kCell * kCell);
        }
      }
    }
  }
}

float CanopyLight::at(const Vector3f& point) const {
  if (density_.empty()) return 1;
  float light = 0, weight = 0;
  for (const Vector3f& direction : kDirections) {
    const float share = 0.5f + 0.5f * direction.z();
    light += share * std::exp(-0.5f * leaf_area_along(point, direction));
    weight += share;
  }
  return std::clamp(0.06f + 0.94f * light / weight, 0.0f, 1.0f);
}

const float* CanopyLight::find(const Vector3f& point) const {
  const Eigen::Vector3i cell = ((point - box_.min()) / kCell).array().floor().cast<int>();
  if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) return nullptr;
  return &density_[static_cast<std::size_t>((cell.z() * size_.y() + cell.y()) * size_.x() +
                                            cell.x())];
}

float CanopyLight::leaf_area_along(const Vector3f& from, const Vector3f& direction) const {
  float area = 0;
  for (int step = 1; step <= 8; ++step) {
    if (const float* cell = find(from + (step * kCell) * direction)) area += *cell * kCell;
  }
  return area;
}

}  // namespace vinebench::sim
