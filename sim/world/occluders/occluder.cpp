// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluders/occluder.h"

#include <array>

namespace vinebench::sim {
namespace {

/// What holds where a file does not say.
struct Usual {
  OccluderClass kind;
  Eigen::Vector3d size;    ///< m
  Eigen::Vector3d colour;  ///< sRGB
};

/// In the order of Occluder::Shape. A person's size is that of the figure of 1.75 m.
const Usual& usual(Occluder::Shape shape) {
  static const std::array<Usual, 6> kUsual{
      {{OccluderClass::kCarton, {0.6, 0.4, 0.4}, {0.42, 0.29, 0.18}},
       {OccluderClass::kPerson, {0.34, 0.56, 1.75}, {0.16, 0.30, 0.55}},
       {OccluderClass::kCrate, {0.6, 0.4, 0.3}, {0.16, 0.30, 0.55}},
       {OccluderClass::kOther, {0.6, 0.6, 0.9}, {0.16, 0.30, 0.55}},
       {OccluderClass::kTarpaulin, {0.08, 2.0, 1.5}, {0.13, 0.33, 0.22}},
       {OccluderClass::kOther, {0.6, 0.4, 0.4}, {0.8, 0.8, 0.8}}}};
  return kUsual.at(static_cast<std::size_t>(shape));
}

}  // namespace

OccluderClass class_of(const Occluder& occluder) {
  return occluder.kind.value_or(usual(occluder.shape).kind);
}

std::string name_of(const Occluder& occluder) {
  return occluder.name.empty() ? name_of(class_of(occluder)) : occluder.name;
}

Eigen::Vector3d size_of(const Occluder& occluder) {
  const Eigen::Vector3d& size = usual(occluder.shape).size;
  if (occluder.shape == Occluder::Shape::kPerson) return occluder.height / size.z() * size;
  return occluder.size.value_or(size);
}

Eigen::Vector3d colour_of(const Occluder& occluder) {
  return occluder.colour.value_or(usual(occluder.shape).colour);
}

}  // namespace vinebench::sim
