// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/keyframe_selector.h"

#include <algorithm>
#include <numbers>

namespace vinebench::slam {
namespace {

/// While a tag is in view keyframes are this near to each other.
constexpr double kTagKeyframeDistance = 0.05;  // m

/// Features with a stereo depth that no landmark explains yet.
int count_new(const TrackedFrame& tracked) {
  int count = 0;
  for (std::size_t v = 0; v < tracked.associations.size(); ++v) {
    for (std::size_t f = 0; f < tracked.frame->views[v].detected(); ++f) {
      count += tracked.associations[v][f] < 0 && tracked.frame->views[v].stereo[f].depth > 0;
    }
  }
  return count;
}

/// Landmarks of a keyframe that it does not see alone.
int count_founded(const Keyframe& keyframe, const Map& map) {
  const int keyframes = std::min<int>(3, static_cast<int>(map.keyframes().size()));
  int count = 0;
  for (const std::vector<int>& view : keyframe.landmarks) {
    for (const int id : view) {
      count += id >= 0 && count_keyframes(map.landmark(id)) >= keyframes;
    }
  }
  return count;
}

/// Whether a frame is `times` as far from a keyframe as keyframes may be apart.
bool is_farther(const TrackedFrame& tracked, const Keyframe& keyframe, double times,
                const KeyframeConfig& config) {
  const Pose step = keyframe.T_map_body.inverse() * tracked.motion.T_map_body;
  return step.translation.norm() > times * config.distance ||
         angle_of(step.rotation) > times * config.angle_deg * std::numbers::pi / 180;
}

}  // namespace

bool wants_keyframe(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config) {
  const Keyframe& last = map.keyframes().back();
  if (tracked.frame->index - last.frame->index < config.min_gap) return false;
  const int inliers = tracked.motion.inliers;
  const bool weak =
      inliers < config.min_inliers || inliers < config.reduction * count_founded(last, map);
  const bool moved = is_farther(tracked, last, 1, config);
  // Without anything new to see, a keyframe would add nothing.
  const bool something_new = count_new(tracked) > inliers / 10;
  return moved || (weak && something_new);
}

bool is_overdue(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config) {
  return is_farther(tracked, map.keyframes().back(), 2, config);
}

bool is_covered(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config) {
  if (tracked.motion.inliers < config.min_inliers) return false;
  for (const Keyframe& keyframe : map.keyframes()) {
    if (!keyframe.inherited()) return false;  // they come first
    if (!is_farther(tracked, keyframe, 1, config)) return true;
  }
  return false;
}

bool sees_tag_from_elsewhere(const TrackedFrame& tracked, const Map& map) {
  const Pose& last = map.keyframes().back().T_map_body;
  const double moved = (last.translation - tracked.motion.T_map_body.translation).norm();
  return !tracked.frame->tags.empty() && moved > kTagKeyframeDistance;
}

}  // namespace vinebench::slam
