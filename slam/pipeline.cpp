// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/pipeline.h"

#include <numbers>

#include "slam/base/error.h"
#include "slam/keyframe_selector.h"

namespace vinebench {
namespace {

/// A map begins with at least this many stereo points.
constexpr int kMinFirstPoints = 100;

/// While a tag is in view keyframes are this near to each other, so that it is seen from several
/// places.
constexpr double kTagKeyframeDistance = 0.05;  // m

/// Whether a loaded map knows the place as well as a new keyframe would.
bool is_covered(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config) {
  if (tracked.motion.inliers < config.min_inliers) return false;
  for (const Keyframe& keyframe : map.keyframes()) {
    if (!keyframe.inherited()) return false;  // they come first
    const Pose step = keyframe.T_map_body.inverse() * tracked.motion.T_map_body;
    if (step.translation.norm() <= config.distance &&
        angle_of(step.rotation) <= config.angle_deg * std::numbers::pi / 180) {
      return true;
    }
  }
  return false;
}

}  // namespace

Pipeline::Pipeline(const SlamConfig& config, const StereoRig& rig,
                   const std::vector<RegisteredTag>& tags)
    : config_(config),
      rig_(rig, config.features, config.refinement, config.stereo),
      map_(config.features.scale),
      tracker_(config.tracking, rig_),
      mapper_(config, rig_),
      scheduler_(config.mapping),
      loop_closer_(config, rig_, tags) {}

void Pipeline::continue_from(Map map) {
  if (!map_.keyframes().empty()) fail("a map can be loaded before the first frame only");
  map_ = std::move(map);
  loop_closer_.take_over(map_);
}

Estimate Pipeline::process(const std::shared_ptr<FrameFeatures>& frame) {
  scheduler_.tick();
  if (scheduler_.due()) join_mapping();
  TrackedFrame tracked = started_                   ? track(frame)
                         : map_.keyframes().empty() ? initialise(frame)
                                                    : relocalise(frame);
  Estimate estimate = report(tracked);
  if (tracked.tracked) {
    estimate.rejected_tags =
        loop_closer_.judge(*frame, tracked.motion.T_map_body, path_length_, map_);
  }
  if (tracked.tracked && wants_new_keyframe(tracked)) map_keyframe(tracked, estimate);
  frame->pyramids.clear();
  frame->right_pyramids.clear();
  if (!tracked.tracked) return estimate;
  loop_closer_.note(*frame, tracker_.T_map_body(), path_length_, map_);
  remember(frame->stamp);
  estimate.T_map_body = tracker_.T_map_body();
  return estimate;
}

SlamSummary Pipeline::finish() {
  join_mapping();
  if (tags_since_adjustment_) {
    const ScopedTimer timer(times_, "global adjustment");
    loop_closer_.adjust_globally(map_);
    tags_since_adjustment_ = false;
  }
  SlamSummary summary;
  for (const FrameRecord& record : records_) {
    summary.trajectory.push_back(
        {record.stamp, map_.keyframe(record.keyframe).T_map_body * record.T_keyframe_body});
  }
  for (const Keyframe& keyframe : map_.keyframes()) {
    if (keyframe.inherited()) continue;
    summary.keyframes.push_back({keyframe.frame->stamp, keyframe.T_map_body});
  }
  summary.landmarks = map_.count_landmarks(config_.mapping.min_observations);
  return summary;
}

/// The first frame with enough stereo points is the map's first keyframe. A registered tag in it
/// makes the map's frame the world's; without one the body is at the origin.
TrackedFrame Pipeline::initialise(const std::shared_ptr<FrameFeatures>& frame) {
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.associations = no_associations(*frame);
  for (const StereoView& view : frame->views) {
    int points = 0;
    for (const StereoMatch& match : view.stereo) points += match.depth > 0;
    tracked.motion.matches_per_view.push_back(points);
    tracked.motion.inliers_per_view.push_back(points);
    tracked.motion.inliers += points;
  }
  tracked.tracked = tracked.motion.inliers >= kMinFirstPoints;
  if (tracked.tracked) {
    tracked.motion.T_map_body = loop_closer_.world_pose(frame->tags).value_or(Pose{});
    tracker_.start(tracked.motion.T_map_body, frame->stamp);
  }
  return tracked;
}

/// Where in a loaded map the body is: by a tag that the map knows, else by the looks of the place.
/// Either must be borne out by tracking from there.
TrackedFrame Pipeline::relocalise(const std::shared_ptr<FrameFeatures>& frame) {
  const ScopedTimer timer(times_, "relocalisation");
  std::optional<Pose> T_map_body = loop_closer_.map_pose(frame->tags, map_);
  if (!T_map_body) T_map_body = relocaliser_.find(map_, rig_, *frame);
  if (T_map_body) {
    tracker_.start(*T_map_body, frame->stamp);
    TrackedFrame tracked = tracker_.track(frame, map_);
    started_ = tracked.tracked;
    return tracked;
  }
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.motion.matches_per_view.assign(frame->views.size(), 0);
  tracked.motion.inliers_per_view.assign(frame->views.size(), 0);
  return tracked;
}

TrackedFrame Pipeline::track(const std::shared_ptr<FrameFeatures>& frame) {
  const ScopedTimer timer(times_, "tracking");
  const Pose before = tracker_.T_map_body();
  TrackedFrame tracked = tracker_.track(frame, map_);
  if (!tracked.tracked) {
    if (const auto by_tag = loop_closer_.map_pose(frame->tags, map_)) {
      tracker_.start(*by_tag, frame->stamp);
      tracked = tracker_.track(frame, map_);
    }
  }
  if (tracked.tracked) {
    path_length_ += (tracker_.T_map_body().translation - before.translation).norm();
  }
  return tracked;
}

bool Pipeline::wants_new_keyframe(const TrackedFrame& tracked) const {
  if (!started_) return true;
  // Live, a robot's tracking waits for the mapping before only when it would soon be lost.
  const bool waits = config_.mapping.schedule == MappingSchedule::kLockstep ||
                     tracked.motion.inliers < config_.keyframes.min_inliers / 2;
  if (scheduler_.busy() && !waits) return false;
  if (is_covered(tracked, map_, config_.keyframes)) {
    return loop_closer_.sees_loop(*tracked.frame, path_length_);
  }
  const Keyframe& last = map_.keyframes().back();
  const double moved = (last.T_map_body.translation - tracked.motion.T_map_body.translation).norm();
  const bool tag_from_elsewhere = !tracked.frame->tags.empty() && moved > kTagKeyframeDistance;
  return tag_from_elsewhere || loop_closer_.sees_loop(*tracked.frame, path_length_) ||
         wants_keyframe(tracked, map_, config_.keyframes);
}

/// Takes over what local mapping found; the latest poses move with it.
void Pipeline::join_mapping(TrackedFrame* tracked) {
  const Pose T_new_old = scheduler_.join(map_, times_);
  tracker_.correct(T_new_old * tracker_.T_map_body());
  if (tracked != nullptr) tracked->motion.T_map_body = T_new_old * tracked->motion.T_map_body;
}

void Pipeline::map_keyframe(TrackedFrame& tracked, Estimate& estimate) {
  if (scheduler_.busy()) join_mapping(&tracked);
  const bool loop = started_ && loop_closer_.sees_loop(*tracked.frame, path_length_);
  const int id = mapper_.insert(tracked, map_);
  tags_since_adjustment_ |= closures_ > 0 && !tracked.frame->tags.empty();
  if (loop) {
    const ScopedTimer timer(times_, "global adjustment");
    estimate.loop_closure = loop_closer_.close(id, path_length_, map_);
    ++closures_;
    tags_since_adjustment_ = false;
  }
  if (started_) {
    const ScopedTimer timer(times_, "local mapping");
    mapper_.extend(id, map_);
    scheduler_.start(mapper_.local_adjustment(id, map_), id);
    if (scheduler_.due()) join_mapping();
  }
  tracker_.correct(map_.keyframe(id).T_map_body);
  tracker_.expect(landmark_ids(map_.keyframe(id).landmarks));
  estimate.keyframe = true;
  started_ = true;
}

void Pipeline::remember(Stamp stamp) {
  const Keyframe& last = map_.keyframes().back();
  records_.push_back({stamp, last.id, last.T_map_body.inverse() * tracker_.T_map_body()});
}

Estimate Pipeline::report(const TrackedFrame& tracked) const {
  const FrameFeatures& frame = *tracked.frame;
  Estimate estimate;
  estimate.stamp = frame.stamp;
  estimate.status = tracked.tracked ? TrackingStatus::kTracking
                    : started_      ? TrackingStatus::kLost
                                    : TrackingStatus::kInitializing;
  estimate.tags = frame.tags;
  estimate.cameras.resize(rig_.rig.cameras.size());
  for (std::size_t p = 0; p < rig_.rig.pairs.size(); ++p) {
    const StereoEye& pair = rig_.rig.pairs[p];
    const StereoView& view = frame.views[p];
    CameraCounts& left = estimate.cameras[static_cast<std::size_t>(pair.left_camera)];
    left.features = static_cast<int>(view.features.size());
    for (const StereoMatch& match : view.stereo) left.stereo += match.depth > 0;
    left.matches = tracked.motion.matches_per_view[p];
    left.inliers = tracked.motion.inliers_per_view[p];
    // The right eye's part is where the left eye's features were found in it.
    estimate.cameras[static_cast<std::size_t>(pair.right_camera)].features = left.stereo;
  }
  return estimate;
}

}  // namespace vinebench
