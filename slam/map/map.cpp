// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vinebench::slam {
namespace {

auto order_of(const Observation& o) {
  return std::tie(o.keyframe, o.view);
}

const Keypoint& keypoint_of(const Keyframe& keyframe, const Observation& o) {
  return keyframe.frame->views[static_cast<std::size_t>(o.view)]
      .features.keypoints[static_cast<std::size_t>(o.feature)];
}

const Descriptor& descriptor_of(const Keyframe& keyframe, const Observation& o) {
  return keyframe.frame->views[static_cast<std::size_t>(o.view)]
      .features.descriptors[static_cast<std::size_t>(o.feature)];
}

/// Index of the descriptor whose median distance to the others is least.
std::size_t median_descriptor(const std::vector<Descriptor>& descriptors) {
  std::size_t best = 0;
  int best_median = 257;
  std::vector<int> distances(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    for (std::size_t j = 0; j < descriptors.size(); ++j) {
      distances[j] = hamming_distance(descriptors[i], descriptors[j]);
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < best_median) {
      best_median = *middle;
      best = i;
    }
  }
  return best;
}

}  // namespace

int count_keyframes(const Landmark& landmark) {
  int count = 0;
  int last = -1;
  for (const Observation& o : landmark.observations) {
    if (o.keyframe != last) ++count;
    last = o.keyframe;
  }
  return count;
}

const MapTag* Map::find_tag(const std::string& family, int id) const {
  for (const MapTag& tag : tags_) {
    if (tag.family == family && tag.id == id) return &tag;
  }
  return nullptr;
}

bool Map::is_held(const MapTag& tag) const {
  return tag.fixed || (tag.survey && std::ranges::count_if(tags_, &MapTag::registered) == 1);
}

int Map::add_keyframe(std::shared_ptr<const FrameFeatures> frame, const Pose& T_map_body,
                      const Associations& associations) {
  const int id = static_cast<int>(keyframes_.size());
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.landmarks = no_associations(*frame);
  keyframe.frame = std::move(frame);
  keyframe.T_map_body = T_map_body;
  keyframes_.push_back(std::move(keyframe));
  for (std::size_t v = 0; v < associations.size(); ++v) {
    for (std::size_t f = 0; f < associations[v].size(); ++f) {
      const int landmark = associations[v][f];
      if (landmark < 0 || this->landmark(landmark).removed) continue;
      add_observation(landmark, {id, static_cast<int>(v), static_cast<int>(f)});
    }
  }
  return id;
}

int Map::add_landmark(const Eigen::Vector3d& position, const Observation& observation) {
  const int id = static_cast<int>(landmarks_.size());
  Landmark landmark;
  landmark.id = id;
  landmark.position = position;
  landmark.first_keyframe = observation.keyframe;
  landmark.descriptor = descriptor_of(keyframe(observation.keyframe), observation);
  landmarks_.push_back(std::move(landmark));
  add_observation(id, observation);
  return id;
}

std::span<const Landmark> Map::begun_with(int keyframe) const {
  const auto begin = std::ranges::lower_bound(landmarks_, keyframe, {}, &Landmark::first_keyframe);
  const auto end = std::ranges::upper_bound(landmarks_, keyframe, {}, &Landmark::first_keyframe);
  return {begin, end};
}

void Map::change_covisibility(const Landmark& landmark, int keyframe_id, int change) {
  int last = -1;
  for (const Observation& o : landmark.observations) {
    if (o.keyframe == keyframe_id || o.keyframe == last) continue;
    last = o.keyframe;
    for (const auto& [a, b] : {std::pair{keyframe_id, o.keyframe}, {o.keyframe, keyframe_id}}) {
      std::map<int, int>& shared = keyframe(a).covisible;
      if ((shared[b] += change) <= 0) shared.erase(b);
    }
  }
}

bool Map::add_observation(int id, const Observation& observation) {
  Landmark& landmark = this->landmark(id);
  int& slot = keyframe(observation.keyframe)
                  .landmarks[static_cast<std::size_t>(observation.view)]
                            [static_cast<std::size_t>(observation.feature)];
  if (slot >= 0) return false;
  const auto at = std::lower_bound(
      landmark.observations.begin(), landmark.observations.end(), observation,
      [](const Observation& a, const Observation& b) { return order_of(a) < order_of(b); });
  if (at != landmark.observations.end() && order_of(*at) == order_of(observation)) return false;
  const bool new_keyframe =
      std::none_of(landmark.observations.begin(), landmark.observations.end(),
                   [&](const Observation& o) { return o.keyframe == observation.keyframe; });
  if (new_keyframe) change_covisibility(landmark, observation.keyframe, 1);
  landmark.observations.insert(at, observation);
  slot = id;
  return true;
}

void Map::remove_observation(int id, const Observation& observation) {
  Landmark& landmark = this->landmark(id);
  std::erase_if(landmark.observations, [&](const Observation& o) {
    return order_of(o) == order_of(observation) && o.feature == observation.feature;
  });
  keyframe(observation.keyframe)
      .landmarks[static_cast<std::size_t>(observation.view)]
                [static_cast<std::size_t>(observation.feature)] = -1;
  const bool last_of_keyframe =
      std::none_of(landmark.observations.begin(), landmark.observations.end(),
                   [&](const Observation& o) { return o.keyframe == observation.keyframe; });
  if (last_of_keyframe) change_covisibility(landmark, observation.keyframe, -1);
  if (!landmark.observations.empty()) return;
  landmark.removed = true;
  landmark.observations.shrink_to_fit();
}

void Map::remove_landmark(int id) {
  const std::vector<Observation> observations = landmark(id).observations;
  for (const Observation& o : observations) remove_observation(id, o);
  landmark(id).removed = true;
}

void Map::merge(int from, int into) {
  const std::vector<Observation> observations = landmark(from).observations;
  for (const Observation& o : observations) {
    remove_observation(from, o);
    add_observation(into, o);
  }
  landmark(from).removed = true;
}

void Map::refresh(int id, const std::vector<Pose>& T_body_cams) {
  Landmark& landmark = this->landmark(id);
  const auto T_map_body = [this](int seen_by) { return keyframe(seen_by).T_map_body; };
  static_cast<LandmarkLook&>(landmark) = look_of(landmark, T_map_body, T_body_cams);
}

LandmarkLook Map::look_of(const Landmark& landmark, const std::function<Pose(int)>& T_map_body,
                          const std::vector<Pose>& T_body_cams) const {
  LandmarkLook look = landmark;
  if (landmark.removed || landmark.observations.empty()) return look;
  std::vector<Descriptor> descriptors;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d from_last;
  for (const Observation& o : landmark.observations) {
    descriptors.push_back(descriptor_of(keyframe(o.keyframe), o));
    from_last = landmark.position -
                T_map_body(o.keyframe) * T_body_cams[static_cast<std::size_t>(o.view)].translation;
    sum += from_last.normalized();
  }
  if (sum.norm() > 1e-9) look.normal = sum.normalized();
  look.descriptor = descriptors[median_descriptor(descriptors)];
  const Observation& last = landmark.observations.back();
  look.max_distance =
      from_last.norm() * std::pow(level_scale_, keypoint_of(keyframe(last.keyframe), last).level);
  return look;
}

std::vector<int> Map::covisible(int id, int at_most) const {
  std::vector<std::pair<int, int>> ranked;  // negated number of shared landmarks, keyframe
  for (const auto& [other, shared] : keyframe(id).covisible) ranked.emplace_back(-shared, other);
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> ids;
  for (const auto& [shared, other] : ranked) {
    if (static_cast<int>(ids.size()) == at_most) break;
    ids.push_back(other);
  }
  return ids;
}

std::size_t Map::count_landmarks(int min_observations) const {
  return static_cast<std::size_t>(
      std::count_if(landmarks_.begin(), landmarks_.end(), [&](const Landmark& landmark) {
        return !landmark.removed && count_keyframes(landmark) >= min_observations;
      }));
}

}  // namespace vinebench::slam
