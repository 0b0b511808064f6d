// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop_closer.h"

#include "slam/base/error.h"
#include "slam/bundle_adjustment.h"

namespace vinebench {
namespace {

/// The earliest keyframe of this run that saw the tag, and how it saw it.
const TagSighting* first_sighting(const Map& map, const TagSighting& tag, int& keyframe_id) {
  for (const Keyframe& keyframe : map.keyframes()) {
    if (keyframe.inherited()) continue;
    for (const TagSighting& sighting : keyframe.frame->tags) {
      if (sighting.family == tag.family && sighting.id == tag.id) {
        keyframe_id = keyframe.id;
        return &sighting;
      }
    }
  }
  return nullptr;
}

/// Moves keyframes after `first` up to `last` by a growing part of the correction of the last one,
/// by the way driven, and every landmark with the keyframe that made it.
void spread_correction(Map& map, int first, int last, const Pose& corrected) {
  std::vector<double> way{0};
  for (int k = first + 1; k <= last; ++k) {
    way.push_back(way.back() + (map.keyframe(k).T_map_body.translation -
                                map.keyframe(k - 1).T_map_body.translation)
                                   .norm());
  }
  // The correction turns about the place of the last keyframe, so that its lever arm stays short.
  const Pose T_last_new = map.keyframe(last).T_map_body.inverse() * corrected;
  std::vector<Pose> moves(map.keyframes().size());
  for (int k = first + 1; k <= last; ++k) {
    const double share = way.back() > 0 ? way[static_cast<std::size_t>(k - first)] / way.back() : 1;
    const Pose T_last_part = interpolate(Pose{}, T_last_new, share);
    const Pose& T_map_last = map.keyframe(last).T_map_body;
    moves[static_cast<std::size_t>(k)] = T_map_last * T_last_part * T_map_last.inverse();
  }
  for (Landmark& landmark : map.landmarks()) {
    landmark.position =
        moves[static_cast<std::size_t>(landmark.first_keyframe)] * landmark.position;
  }
  for (int k = first + 1; k <= last; ++k) {
    Pose& T_map_body = map.keyframe(k).T_map_body;
    T_map_body = moves[static_cast<std::size_t>(k)] * T_map_body;
  }
}

}  // namespace

const RegisteredTag* LoopCloser::registered(const TagSighting& sighting) const {
  for (const RegisteredTag& tag : registered_) {
    if (tag.family == sighting.family && tag.id == sighting.id) return &tag;
  }
  return nullptr;
}

const LoopCloser::Visit* LoopCloser::visit(const TagSighting& sighting) const {
  for (const Visit& visit : visits_) {
    if (visit.family == sighting.family && visit.id == sighting.id) return &visit;
  }
  return nullptr;
}

void LoopCloser::remember_visit(const TagSighting& sighting, Stamp stamp, double path_length,
                                bool in_keyframe) {
  const Visit* before = visit(sighting);
  in_keyframe |= before != nullptr && before->in_keyframe;
  std::erase_if(visits_, [&](const Visit& visit) {
    return visit.family == sighting.family && visit.id == sighting.id;
  });
  visits_.push_back({sighting.family, sighting.id, stamp, path_length, in_keyframe});
}

Pose LoopCloser::T_body_tag(const TagSighting& sighting) const {
  return rig_.rig.cameras[static_cast<std::size_t>(sighting.camera)].T_body_cam *
         sighting.T_cam_tag;
}

void LoopCloser::take_over(const Map& map) {
  for (const MapTag& tag : map.tags()) {
    for (const RegisteredTag& known : registered_) {
      const bool same = known.family == tag.family && known.id == tag.id;
      if (same && tag.fixed) T_map_world_ = tag.T_map_tag * known.T_world_tag.inverse();
    }
  }
}

std::optional<Pose> LoopCloser::world_pose(const std::vector<TagSighting>& sightings) const {
  for (const TagSighting& sighting : sightings) {
    if (const RegisteredTag* tag = registered(sighting)) {
      return tag->T_world_tag * T_body_tag(sighting).inverse();
    }
  }
  return std::nullopt;
}

std::optional<Pose> LoopCloser::map_pose(const std::vector<TagSighting>& sightings,
                                         Map& map) const {
  for (const TagSighting& sighting : sightings) {
    if (const MapTag* tag = map.find_tag(sighting.family, sighting.id)) {
      return tag->T_map_tag * T_body_tag(sighting).inverse();
    }
  }
  return std::nullopt;
}

const TagSighting* LoopCloser::loop_sighting(const FrameFeatures& frame, double path_length) const {
  if (!config_.loop.enabled) return nullptr;
  for (const TagSighting& sighting : frame.tags) {
    const Visit* last = visit(sighting);
    if (last == nullptr || !last->in_keyframe) continue;
    const bool left = to_seconds(frame.stamp - last->last_seen) >= config_.loop.away_seconds &&
                      path_length - last->path_length >= config_.loop.away_distance;
    if (left) return &sighting;
  }
  return nullptr;
}

bool LoopCloser::sees_loop(const FrameFeatures& frame, double path_length) const {
  return loop_sighting(frame, path_length) != nullptr;
}

void LoopCloser::note(const FrameFeatures& frame, const Pose& T_map_body, double path_length,
                      Map& map) {
  const bool is_keyframe =
      !map.keyframes().empty() && map.keyframes().back().frame->index == frame.index;
  for (const TagSighting& sighting : frame.tags) {
    const Pose T_map_tag = T_map_body * T_body_tag(sighting);
    if (map.find_tag(sighting.family, sighting.id) == nullptr) {
      MapTag tag{sighting.family, sighting.id, config_.tags.size, T_map_tag, false};
      if (const RegisteredTag* known = registered(sighting)) {
        if (!T_map_world_) T_map_world_ = T_map_tag * known->T_world_tag.inverse();
        tag.size = known->size;
        tag.T_map_tag = *T_map_world_ * known->T_world_tag;
        tag.fixed = true;
      }
      map.tags().push_back(tag);
    }
    remember_visit(sighting, frame.stamp, path_length, is_keyframe);
  }
}

LoopClosure LoopCloser::close(int keyframe_id, double path_length, Map& map) {
  const Keyframe& later = map.keyframe(keyframe_id);
  const TagSighting* sighting = loop_sighting(*later.frame, path_length);
  int first = keyframe_id;
  const TagSighting* earlier = sighting ? first_sighting(map, *sighting, first) : nullptr;
  const MapTag* tag = sighting ? map.find_tag(sighting->family, sighting->id) : nullptr;
  if (earlier == nullptr || tag == nullptr || first == keyframe_id) {
    fail("loop closing: keyframe {} sees no tag that an earlier one saw and left", keyframe_id);
  }
  const Pose before = later.T_map_body;
  LoopClosure closure;
  closure.tag_id = sighting->id;
  closure.earlier = map.keyframe(first).frame->stamp;
  closure.later = later.frame->stamp;
  closure.T_earlier_later = T_body_tag(*earlier) * T_body_tag(*sighting).inverse();
  spread_correction(map, first, keyframe_id, tag->T_map_tag * T_body_tag(*sighting).inverse());
  adjust_globally(map);
  closure.correction =
      (map.keyframe(keyframe_id).T_map_body.translation - before.translation).norm();
  return closure;
}

void LoopCloser::adjust_globally(Map& map) const {
  AdjustmentOptions options;
  options.iterations = config_.mapping.global_iterations;
  options.tag_corner_sigma = config_.loop.corner_sigma;
  options.global = true;
  adjust(map, global_window(map), rig_, options);
}

}  // namespace vinebench
