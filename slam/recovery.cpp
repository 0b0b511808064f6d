// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/recovery.h"

#include <utility>

#include "slam/frame/measurements.h"
#include "slam/loop/loop_correction.h"
#include "slam/tracking/place_evidence.h"

namespace vinebench::slam {
namespace {

/// A map begins with at least this many stereo points.
constexpr int kMinFirstPoints = 100;

/// Frames in a row that see that many and find nothing of the map: a new map part starts.
constexpr int kFramesBeforeRestart = 3;

/// As many where they resemble a place that the map has.
constexpr int kFramesOfDoubt = 10;

/// Nobody carries a robot faster, nor farther at once.
constexpr double kCarryingSpeed = 2;    // m/s
constexpr double kCarriedAtOnce = 0.1;  // m

}  // namespace

bool sees_well(const FrameFeatures& frame) {
  int points = 0;
  for (const StereoView& view : frame.views) points += count_with_depth(view.stereo);
  return points >= kMinFirstPoints;
}

TrackedFrame Recovery::relocalise(const std::shared_ptr<FrameFeatures>& frame) {
  std::optional<Pose> T_map_body = loop_closer_.gates().map_pose(frame->tags, map_);
  if (!T_map_body) T_map_body = relocaliser_.find(map_, rig_, *frame);
  if (T_map_body) {
    tracker_.start(*T_map_body, frame->stamp);
    return tracker_.track(frame, map_, rig_);
  }
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.motion.matches_per_view.assign(frame->views.size(), 0);
  tracked.motion.inliers_per_view.assign(frame->views.size(), 0);
  return tracked;
}

bool Recovery::find_again(TrackedFrame& tracked) {
  const std::shared_ptr<FrameFeatures> frame = tracked.frame;
  if (const auto by_tag = loop_closer_.gates().map_pose(frame->tags, map_)) {
    tracker_.start(*by_tag, frame->stamp);
    tracked = tracker_.track(frame, map_, rig_);
    return false;
  }
  const bool reckons = !tracker_.dead_reckoning().is_lost();
  if (reckons && !sees_well(*frame)) return false;
  const auto by_looks = relocaliser_.find(map_, rig_, *frame);
  if (!by_looks) return false;
  const double carried = (by_looks->translation - tracker_.T_map_body().translation).norm();
  const double seconds = to_seconds(frame->stamp - last_tracked_);
  if (reckons && carried > kCarriedAtOnce + kCarryingSpeed * seconds) return false;
  if (reckons && !bears_out(look_around(map_, rig_, *frame, *by_looks))) return false;
  Tracker there = tracker_;
  there.start(*by_looks, frame->stamp, !reckons);
  TrackedFrame found = there.track(frame, map_, rig_);
  if (!found.tracked) return false;
  tracker_ = std::move(there);
  tracked = std::move(found);
  return reckons;
}

bool Recovery::restart_map(TrackedFrame& tracked, double path_length) {
  seeing_frames_ = sees_well(*tracked.frame) ? seeing_frames_ + 1 : 0;
  const int frames = relocaliser_.has_candidate() ? kFramesOfDoubt : kFramesBeforeRestart;
  if (seeing_frames_ < frames || tracker_.dead_reckoning().is_lost()) return false;
  const Keyframe& last = map_.keyframes().back();
  tracked.motion.T_map_body = tracker_.T_map_body();
  tracked.link = OdometryLink{last.id, last.T_map_body.inverse() * tracker_.T_map_body(),
                              tracker_.dead_reckoning().covariance()};
  loop_closer_.gates().cross_gap(path_length, tracker_.dead_reckoning().worst_covariance(),
                                 static_cast<int>(map_.keyframes().size()));
  tracked.associations = no_associations(*tracked.frame);
  tracked.motion.information.setZero();
  tracker_.start(tracked.motion.T_map_body, tracked.frame->stamp);
  tracked.tracked = true;
  last_tracked_ = tracked.frame->stamp;
  seeing_frames_ = 0;
  return true;
}

std::optional<Pose> Recovery::carried_to(const TrackedFrame& tracked, double path_length) const {
  const FrameFeatures& frame = *tracked.frame;
  const auto by_tag = loop_closer_.gates().pose_across_gap(frame.tags, tracked.motion.T_map_body,
                                                           path_length, map_);
  if (!by_tag) return std::nullopt;
  const PlaceEvidence evidence = look_around(map_, rig_, frame, *by_tag);
  if (!bears_out(evidence)) return std::nullopt;
  return evidence.T_map_body;
}

int Recovery::move_to(const Pose& T_map_body, TrackedFrame& tracked) {
  const int after = loop_closer_.gates().open_gap(tracked.frame->tags, map_);
  const Pose T_new_old = T_map_body * tracked.motion.T_map_body.inverse();
  move_from(map_, after, T_new_old);
  tracker_.correct(T_new_old * tracker_.T_map_body());
  tracked.motion.T_map_body = T_new_old * tracked.motion.T_map_body;
  return map_.keyframe(after).link->from;
}

}  // namespace vinebench::slam
