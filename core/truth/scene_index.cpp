// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/scene_index.h"

#include "core/util/error.h"

namespace vinebench {

const SceneIndex::Place* SceneIndex::place_of(std::int32_t number) const {
  const auto index = static_cast<std::size_t>((number >> 8) - 1);
  return number < 256 || index >= places_.size() ? nullptr : &places_[index];
}

const InstanceName& SceneIndex::whole(std::int32_t number) const {
  static const InstanceName kNobody;
  if (number == 0) return kNobody;
  if (const Place* place = place_of(number)) return place->name;
  if (rover_ && (number >> 8) - 1 == static_cast<std::int64_t>(places_.size())) return *rover_;
  fail("instance number {}: the scene has {} instances", number, places_.size());
}

InstanceName SceneIndex::name(std::int32_t number) const {
  InstanceName name = whole(number);
  name.part = number & 255;
  return name;
}

Thing SceneIndex::thing(std::int32_t number) const {
  return whole(number).thing;
}

std::vector<Eigen::Vector3d> SceneIndex::points(std::int32_t number) const {
  const Place* place = place_of(number);
  if (place == nullptr) return {};
  const auto found = points_.find({place->model, number & 255});
  if (found == points_.end()) return {};
  std::vector<Eigen::Vector3d> world;
  for (const Eigen::Vector3f& p : found->second) {
    world.push_back(place->T_world_model * (place->scale * p.cast<double>()));
  }
  return world;
}

std::vector<std::int32_t> SceneIndex::bunches() const {
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].name.thing != Thing::kVine) continue;
    for (auto part = points_.lower_bound({places_[i].model, 1});
         part != points_.end() && part->first.first == places_[i].model; ++part) {
      numbers.push_back(static_cast<std::int32_t>(256 * (i + 1)) + part->first.second);
    }
  }
  return numbers;
}

}  // namespace vinebench
