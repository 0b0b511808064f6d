// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/place_loops.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/step_covariance.h"
#include "slam/tracking/place_evidence.h"

namespace vinebench::slam {
namespace {

/// From so far beside it a place looks much the same.
constexpr double kSight = 0.5;                               // m
constexpr double kSameAxis = 40.0 * std::numbers::pi / 180;  // rad, between two cameras' axes

/// Keyframes farther apart than this are two places.
constexpr double kApart = 0.4;  // m

constexpr int kMostPlaces = 6;
constexpr int kMostKeyframes = 20;  // whose landmarks are looked for

/// A keyframe that shares so many landmarks with earlier ones has been found by tracking.
constexpr int kShared = 50;

/// What two keyframes in a row may differ by in what they say of where the place is.
constexpr double kSameOffset = 0.03;                        // m
constexpr double kSameTurn = 1.0 * std::numbers::pi / 180;  // rad

/// What the pose against a place is uncertain by besides the matches' noise: the place as mapped.
constexpr double kPlaceOffset = 0.003;                       // m
constexpr double kPlaceTurn = 0.2 * std::numbers::pi / 180;  // rad

/// Whether some camera at `a` looks the way some camera at `b` looks.
bool faces_the_same(const Pose& a, const Pose& b, const EstimatorRig& rig) {
  const auto axis = [](const Pose& T_map_body, const Pose& T_body_cam) {
    return Eigen::Vector3d(T_map_body.rotation * (T_body_cam.rotation * Eigen::Vector3d::UnitZ()));
  };
  for (const Pose& of_a : rig.T_body_cams) {
    for (const Pose& of_b : rig.T_body_cams) {
      if (axis(a, of_a).dot(axis(b, of_b)) > std::cos(kSameAxis)) return true;
    }
  }
  return false;
}

double distance_between(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm();
}

}  // namespace

std::optional<PlaceReturn> PlaceLoops::look(int keyframe, double path_length,
                                            const Matrix6d& covariance, const Map& map,
                                            const EstimatorRig& rig) {
  told_.push_back({keyframe, path_length, covariance});
  const std::vector<const Told*> places = beside(keyframe, map, rig);
  const auto before = std::exchange(before_, std::nullopt);
  if (places.empty()) return std::nullopt;
  const bool away = path_length - known_until_ >= config_.away_distance;
  if (auto tied = known(keyframe, places, map)) {
    known_until_ = path_length;
    return away ? std::move(tied) : std::nullopt;
  }
  auto found = away ? find(keyframe, places, map, rig) : std::nullopt;
  if (!found) return std::nullopt;
  before_ = Candidate{keyframe, found->T_map_body};
  if (!before || !agrees(*before, map)) return std::nullopt;
  known_until_ = path_length;
  return found;
}

/// The earlier keyframes that the body may be beside, nearest first.
std::vector<const PlaceLoops::Told*> PlaceLoops::beside(int keyframe, const Map& map,
                                                        const EstimatorRig& rig) const {
  const Pose& now = map.keyframe(keyframe).T_map_body;
  std::vector<std::pair<double, const Told*>> ranked;
  for (const Told& told : told_) {
    const double way = told_.back().path_length - told.path_length;
    if (way < config_.away_distance) break;
    const Pose& then = map.keyframe(told.keyframe).T_map_body;
    const double distance = distance_between(now, then);
    if (distance > config_.max_offset + config_.max_drift * way + kSight) continue;
    if (faces_the_same(now, then, rig)) ranked.emplace_back(distance, &told);
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<double, const Told*>::first);
  std::vector<const Told*> places;
  for (const auto& [distance, told] : ranked) places.push_back(told);
  return places;
}

/// Where the keyframe shares its landmarks with earlier ones.
std::optional<PlaceReturn> PlaceLoops::known(int keyframe, const std::vector<const Told*>& places,
                                             const Map& map) const {
  std::vector<int> shared(map.keyframes().size(), 0);
  const int last_old = (*std::ranges::max_element(places, {}, &Told::keyframe))->keyframe;
  int all = 0;
  for (const int id : landmark_ids(map.keyframe(keyframe).landmarks)) {
    int before = -1;
    bool old = false;
    for (const Observation& o : map.landmark(id).observations) {
      if (o.keyframe > last_old) break;
      if (o.keyframe != before) ++shared[static_cast<std::size_t>(o.keyframe)];
      before = o.keyframe;
      old = true;
    }
    all += old;
  }
  if (all < kShared) return std::nullopt;
  const auto most = std::ranges::max_element(places, {}, [&](const Told* place) {
    return shared[static_cast<std::size_t>(place->keyframe)];
  });
  PlaceReturn found;
  found.earlier = (*most)->keyframe;
  found.earlier_covariance = (*most)->covariance;
  found.T_map_body = map.keyframe(keyframe).T_map_body;
  found.covariance = isotropic_covariance(kPlaceOffset, kPlaceTurn);
  found.tied = true;
  return found;
}

bool PlaceLoops::within_drift(const Pose& T_map_body, int keyframe, const Told& place,
                              const Map& map) const {
  const Pose off = map.keyframe(keyframe).T_map_body.inverse() * T_map_body;
  const double way = told_.back().path_length - place.path_length;
  return off.translation.norm() <= config_.max_offset + config_.max_drift * way &&
         angle_of(off.rotation) <= config_.max_turn_deg * std::numbers::pi / 180;
}

std::optional<PlaceReturn> PlaceLoops::find(int keyframe, const std::vector<const Told*>& places,
                                            const Map& map, const EstimatorRig& rig) const {
  std::vector<int> apart;  // a keyframe of each place
  for (const Told* place : places) {
    const bool same = std::ranges::any_of(apart, [&](int other) {
      return distance_between(map.keyframe(other).T_map_body,
                              map.keyframe(place->keyframe).T_map_body) < kApart;
    });
    if (!same && static_cast<int>(apart.size()) < kMostPlaces) apart.push_back(place->keyframe);
  }
  const FrameFeatures& frame = *map.keyframe(keyframe).frame;
  const auto relocation = relocate_among(map, rig, frame, apart, {});
  if (!relocation) return std::nullopt;
  const Pose& T_map_body = relocation->T_map_body;
  const auto nearest = std::ranges::min_element(places, {}, [&](const Told* place) {
    return distance_between(map.keyframe(place->keyframe).T_map_body, T_map_body);
  });
  if (!within_drift(T_map_body, keyframe, **nearest, map)) return std::nullopt;
  PlaceReturn found;
  found.earlier = (*nearest)->keyframe;
  found.T_map_body = T_map_body;
  found.covariance =
      relocation->information.inverse() + isotropic_covariance(kPlaceOffset, kPlaceTurn);
  found.earlier_covariance = (*nearest)->covariance;
  for (std::size_t p = 0; p < places.size() && p < kMostKeyframes; ++p) {
    const auto more = landmark_ids(map.keyframe(places[p]->keyframe).landmarks);
    found.landmarks.insert(found.landmarks.end(), more.begin(), more.end());
  }
  std::ranges::sort(found.landmarks);
  // Not std::ranges: clang 14 does not compile its subranges with libstdc++ 12.
  found.landmarks.erase(std::unique(found.landmarks.begin(), found.landmarks.end()),
                        found.landmarks.end());
  if (!bears_out(look_around(map, rig, frame, T_map_body, found.landmarks))) return std::nullopt;
  return found;
}

/// Whether the keyframe before was as far from where it was thought to be.
bool PlaceLoops::agrees(const Candidate& before, const Map& map) const {
  const Pose found = before.T_map_body.inverse() * before_->T_map_body;
  const Pose moved = map.keyframe(before.keyframe).T_map_body.inverse() *
                     map.keyframe(before_->keyframe).T_map_body;
  const Pose off = moved.inverse() * found;
  return off.translation.norm() <= kSameOffset && angle_of(off.rotation) <= kSameTurn;
}

}  // namespace vinebench::slam
