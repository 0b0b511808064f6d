// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/loop_closer.h"

#include <malloc.h>

#include <algorithm>

#include "core/geometry/step_covariance.h"
#include "core/util/error.h"
#include "slam/loop/levelling.h"
#include "slam/loop/loop_correction.h"
#include "slam/optimisation/bundle_adjustment.h"

namespace vinebench::slam {
namespace {

/// So many of the last keyframes are tied to a place that is found again.
constexpr int kTiedKeyframes = 5;

double offset_variance(const Matrix6d& covariance) {
  return covariance.topLeftCorner<3, 3>().trace();
}

/// Whether the world's place in the map is an unknown of global adjustment.
bool tells_world(const Map& map) {
  return std::ranges::none_of(map.tags(), [&](const MapTag& tag) { return map.is_held(tag); });
}

}  // namespace

void LoopCloser::record(const FrameFeatures& frame, const Pose& T_map_body, double path_length,
                        Map& map) {
  // A loop that waits to be closed stays one.
  if (sees_loop(frame, path_length)) return;
  const bool is_keyframe =
      !map.keyframes().empty() && map.keyframes().back().frame->index == frame.index;
  if (!map.world()) {
    if (const auto T_world_body = gates_.world_pose(frame.tags)) {
      map.world() = T_map_body * T_world_body->inverse();
      world_is_sure_ = std::ranges::any_of(frame.tags, [&](const TagSighting& seen) {
        return gates_.registered(seen) != nullptr && gates_.places_well(seen);
      });
    }
  }
  for (const TagSighting& sighting : frame.tags) {
    if (gates_.registered(sighting) != nullptr && !map.world()) continue;
    if (map.find_tag(sighting.family, sighting.id) == nullptr) add_tag(sighting, T_map_body, map);
    gates_.remember_visit(sighting, frame.stamp, path_length, is_keyframe);
  }
}

void LoopCloser::add_tag(const TagSighting& sighting, const Pose& T_map_body, Map& map) const {
  MapTag& tag = gates_.add_tag(sighting, T_map_body, map);
  tag.sure = tag.fixed ? world_is_sure_ : gates_.places_well(sighting);
}

/// The surest of the sightings, in the last visit before `later`, of what says where `seen`'s tag
/// is: the last one of a tag that was passed may have been from far away.
std::optional<LoopCloser::EarlierEnd> LoopCloser::earlier_end(const Keyframe& later,
                                                              const TagSighting& seen,
                                                              const Map& map) const {
  const auto tag = gates_.placed(seen, map);
  if (!tag) return std::nullopt;
  const bool by_world = gates_.registered(seen) != nullptr;
  std::optional<EarlierEnd> surest;
  Stamp next = 0;  // of the visit's keyframe after
  for (int k = later.id - 1; k >= 0 && !map.keyframe(k).inherited(); --k) {
    const FrameFeatures& frame = *map.keyframe(k).frame;
    if (surest && to_seconds(next - frame.stamp) >= settings_.loop.away_seconds) break;
    for (const TagSighting& sighting : frame.tags) {
      const bool says =
          by_world ? gates_.registered(sighting) != nullptr : same_tag(sighting, seen);
      if (!says) continue;
      EarlierEnd end{k, &sighting, {}, {}};
      end.T_earlier_tag = T_body_tag(sighting, gates_.cameras()) *
                          gates_.placed(sighting, map)->T_ref_tag.inverse() * tag->T_ref_tag;
      end.covariance = loop_covariance(seen, sighting, end.T_earlier_tag);
      next = frame.stamp;
      if (!surest || offset_variance(end.covariance) < offset_variance(surest->covariance)) {
        surest = end;
      }
    }
  }
  return surest;
}

LoopClosure LoopCloser::close(int keyframe_id, double path_length, const EstimatorRig& rig,
                              Map& map, bool adjusts) {
  const Keyframe& later = map.keyframe(keyframe_id);
  const TagSighting* sighting = gates_.loop_sighting(*later.frame, path_length);
  const auto earlier = sighting ? earlier_end(later, *sighting, map) : std::nullopt;
  if (!earlier) {
    fail("loop closing: keyframe {} sees no tag that an earlier one saw and left", keyframe_id);
  }
  const Pose before = later.T_map_body;
  const Pose T_tag_later = T_body_tag(*sighting, gates_.cameras()).inverse();
  LoopClosure closure;
  closure.tag_id = sighting->id;
  closure.earlier = map.keyframe(earlier->keyframe).frame->stamp;
  closure.later = later.frame->stamp;
  closure.T_earlier_later = earlier->T_earlier_tag * T_tag_later;
  const Pose corrected = gates_.placed(*sighting, map)->T_ref_tag * T_tag_later;
  spread_correction(map, earlier->keyframe, keyframe_id, corrected, earlier->covariance);
  for (const TagSighting& seen : later.frame->tags) {
    if (gates_.registered(seen) != nullptr && !map.world()) continue;
    if (map.find_tag(seen.family, seen.id) == nullptr) add_tag(seen, later.T_map_body, map);
    gates_.remember_visit(seen, later.frame->stamp, path_length, true);
  }
  if (adjusts) adjust_globally(rig, map);
  world_is_sure_ = true;
  if (!same_tag(*earlier->sighting, *sighting)) {
    // One sighting's turn swings what is measured by way of another tag: all of them know better.
    closure.T_earlier_later =
        map.keyframe(earlier->keyframe).T_map_body.inverse() * later.T_map_body;
  } else {
    closure.covariance = earlier->covariance;
  }
  closure.correction =
      (map.keyframe(keyframe_id).T_map_body.translation - before.translation).norm();
  return closure;
}

LoopClosure LoopCloser::close(const PlaceReturn& place, int keyframe, const LocalMapper& mapper,
                              const EstimatorRig& rig, Map& map, bool adjusts) const {
  const Keyframe& earlier = map.keyframe(place.earlier);
  const Keyframe& later = map.keyframe(keyframe);
  const Pose before = later.T_map_body;
  LoopClosure closure;
  closure.tag_id = -1;
  closure.earlier = earlier.frame->stamp;
  closure.later = later.frame->stamp;
  closure.T_earlier_later = earlier.T_map_body.inverse() * place.T_map_body;
  if (!place.tied) {
    closure.covariance = place.covariance;
    spread_correction(map, place.earlier, keyframe, place.T_map_body, place.covariance);
    for (int k = std::max(keyframe - kTiedKeyframes, place.earlier) + 1; k <= keyframe; ++k) {
      mapper.tie(place.landmarks, k, rig, map);
    }
  }
  if (adjusts) adjust_globally(rig, map);
  if (place.tied) closure.T_earlier_later = earlier.T_map_body.inverse() * later.T_map_body;
  closure.correction = (later.T_map_body.translation - before.translation).norm();
  return closure;
}

/// Of T_earlier_later, in the step of the later body. Between two tags their surveys are part of
/// it, and the earlier one's turn swings all that lies between.
Matrix6d LoopCloser::loop_covariance(const TagSighting& later, const TagSighting& earlier,
                                     const Pose& T_earlier_tag) const {
  const Pose T_tag_later = T_body_tag(later, gates_.cameras()).inverse();
  Matrix6d of_tag = gates_.covariance(later);
  if (same_tag(later, earlier)) {
    of_tag += gates_.covariance(earlier);
  } else {
    of_tag += gates_.survey_covariance(later) +
              carry_covariance(gates_.covariance(earlier) + gates_.survey_covariance(earlier),
                               T_body_tag(earlier, gates_.cameras()).inverse() * T_earlier_tag);
  }
  return carry_covariance(of_tag, T_tag_later);
}

/// Of a registered tag's place against the map, in the tag's own frame, by the surest of the
/// keyframes' sightings (what is wrong with one is wrong with its neighbours too) and its survey.
std::optional<Matrix6d> LoopCloser::place_covariance(const MapTag& tag, const Map& map) const {
  std::optional<Matrix6d> surest;
  for (const Keyframe& keyframe : map.keyframes()) {
    for (const TagSighting& sighting : keyframe.frame->tags) {
      if (!same_tag(sighting, tag)) continue;
      const Matrix6d of_tag = gates_.covariance(sighting) + gates_.survey_covariance(sighting);
      if (!surest || of_tag.trace() < surest->trace()) surest = of_tag;
    }
  }
  return surest;
}

void LoopCloser::level(Map& map) const {
  if (!settings_.inertial || !map.world()) return;
  if (std::ranges::count_if(map.tags(), &MapTag::registered) != 1) return;
  const MapTag& tag = *std::ranges::find_if(map.tags(), &MapTag::registered);
  const auto place = place_covariance(tag, map);
  if (!place) return;
  const Eigen::Vector3d down = map.world()->rotation * -Eigen::Vector3d::UnitZ();
  level_about(map, tag.T_map_tag, place->bottomRightCorner<3, 3>(), down, *settings_.inertial);
}

void LoopCloser::adjust_globally(const EstimatorRig& rig, Map& map) const {
  level(map);
  const std::optional<Pose> T_map_world = map.world();
  AdjustmentOptions options;
  options.iterations = settings_.global_iterations;
  options.tag_corner_sigma = settings_.loop.corner_sigma;
  options.global = true;
  options.inertial = settings_.inertial;
  adjust(map, global_window(map), rig, options);
  if (T_map_world && tells_world(map)) keep_world(map, *T_map_world);
  malloc_trim(0);  // of what a long drive's adjustment took, the C library would keep most
}

}  // namespace vinebench::slam
