// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracker.h"

#include <algorithm>
#include <numbers>

#include "slam/match_refiner.h"
#include "slam/patch_follower.h"
#include "slam/projection_matcher.h"

namespace vinebench {
namespace {

/// Keyframes nearer than this that look the same way may show the same vines.
constexpr double kNearby = 1.0;                                 // m
constexpr double kSameHeading = 40.0 * std::numbers::pi / 180;  // rad

/// Beyond this many frames without a pose the last velocity says nothing any more.
constexpr int kCoastFrames = 5;

void add_landmarks_of(const Keyframe& keyframe, std::vector<char>& wanted) {
  for (const std::vector<int>& view : keyframe.landmarks) {
    for (const int id : view) {
      if (id >= 0) wanted[static_cast<std::size_t>(id)] = 1;
    }
  }
}

}  // namespace

std::vector<int> landmark_ids(const Associations& associations) {
  std::vector<int> ids;
  for (const std::vector<int>& view : associations) {
    for (const int id : view) {
      if (id >= 0) ids.push_back(id);
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::vector<int> local_landmarks(const Map& map, const std::vector<int>& seen,
                                 const Pose& T_map_body, int at_most_keyframes) {
  std::vector<int> votes(map.keyframes().size(), 0);
  for (const int id : seen) {
    int last = -1;
    for (const Observation& o : map.landmark(id).observations) {
      if (o.keyframe != last) ++votes[static_cast<std::size_t>(o.keyframe)];
      last = o.keyframe;
    }
  }
  for (const Keyframe& keyframe : map.keyframes()) {
    const Pose T_body_key = T_map_body.inverse() * keyframe.T_map_body;
    const bool near =
        T_body_key.translation.norm() < kNearby && angle_of(T_body_key.rotation) < kSameHeading;
    if (near) ++votes[static_cast<std::size_t>(keyframe.id)];
  }
  std::vector<std::pair<int, int>> ranked;  // negated votes, negated id: the newest first
  for (std::size_t k = 0; k < votes.size(); ++k) {
    if (votes[k] > 0) ranked.emplace_back(-votes[k], -static_cast<int>(k));
  }
  std::sort(ranked.begin(), ranked.end());
  if (ranked.size() > static_cast<std::size_t>(at_most_keyframes)) {
    ranked.resize(static_cast<std::size_t>(at_most_keyframes));
  }
  std::vector<char> wanted(map.landmarks().size(), 0);
  for (const auto& [vote, id] : ranked) add_landmarks_of(map.keyframe(-id), wanted);
  std::vector<int> ids;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i]) ids.push_back(static_cast<int>(i));
  }
  return ids;
}

void Tracker::start(const Pose& T_map_body, Stamp stamp) {
  T_map_body_ = T_map_body;
  stamp_ = stamp;
  velocity_.setZero();
  lost_frames_ = 0;
}

void Tracker::correct(const Pose& T_map_body) {
  T_map_body_ = T_map_body;
}

Pose Tracker::predict(Stamp stamp) const {
  if (lost_frames_ > kCoastFrames) return T_map_body_;
  const double dt = to_seconds(stamp - stamp_);
  const Vector6d step = velocity_ * dt;
  return T_map_body_ * Pose{exp_so3(step.tail<3>()), step.head<3>()};
}

void Tracker::match_near(const Map& map, const std::vector<int>& landmarks,
                         TrackedFrame& tracked) const {
  ProjectionSearch search{config_.radius, config_.max_hamming, config_.second_best};
  for (int step = 0; step < config_.radius_steps; ++step) {
    tracked.associations = no_associations(*tracked.frame);
    const int matches =
        match_by_projection(map, landmarks, *tracked.frame, tracked.motion.T_map_body, rig_, search,
                            tracked.associations);
    if (matches >= config_.min_matches) return;
    search.radius *= config_.radius_growth;
  }
}

void Tracker::match_local_map(const Map& map, const std::vector<int>& local,
                              TrackedFrame& tracked) const {
  match_by_projection(map, local, *tracked.frame, tracked.motion.T_map_body, rig_,
                      {config_.local_radius, config_.max_hamming, config_.second_best},
                      tracked.associations);
}

TrackedFrame Tracker::track(std::shared_ptr<FrameFeatures> frame, const Map& map) {
  TrackedFrame tracked;
  tracked.frame = std::move(frame);
  tracked.motion.T_map_body = predict(tracked.frame->stamp);
  const bool from_map = lost_frames_ > 0 || last_landmarks_.empty();
  const std::vector<int> landmarks =
      from_map ? local_landmarks(map, last_landmarks_, tracked.motion.T_map_body,
                                 config_.local_keyframes)
               : last_landmarks_;
  match_near(map, landmarks, tracked);
  tracked.motion = estimate_motion(map, *tracked.frame, tracked.motion.T_map_body, rig_,
                                   config_.min_inlier_share, tracked.associations);
  if (tracked.motion.inliers >= config_.min_inliers / 2) {
    const std::vector<int> local =
        local_landmarks(map, landmark_ids(tracked.associations), tracked.motion.T_map_body,
                        config_.local_keyframes);
    match_local_map(map, local, tracked);
    tracked.motion = estimate_motion(map, *tracked.frame, tracked.motion.T_map_body, rig_,
                                     config_.min_inlier_share, tracked.associations);
    refine_matches(map, tracked.motion.T_map_body, rig_, *tracked.frame, tracked.associations);
    tracked.motion = estimate_motion(map, *tracked.frame, tracked.motion.T_map_body, rig_,
                                     config_.min_inlier_share, tracked.associations);
    follow_patches(map, local, tracked.motion.T_map_body, rig_, *tracked.frame,
                   tracked.associations);
    tracked.motion = estimate_motion(map, *tracked.frame, tracked.motion.T_map_body, rig_,
                                     config_.min_inlier_share, tracked.associations);
  }
  judge(tracked);
  return tracked;
}

void Tracker::judge(TrackedFrame& tracked) {
  int matches = 0;
  for (const int n : tracked.motion.matches_per_view) matches += n;
  tracked.tracked = tracked.motion.inliers >= config_.min_inliers &&
                    tracked.motion.inliers >= config_.min_inlier_share * matches;
  if (!tracked.tracked) {
    ++lost_frames_;
    return;
  }
  const double dt = to_seconds(tracked.frame->stamp - stamp_);
  if (dt > 0) {
    const Pose step = T_map_body_.inverse() * tracked.motion.T_map_body;
    velocity_ << step.translation / dt, log_so3(step.rotation) / dt;
  }
  if (lost_frames_ > kCoastFrames) velocity_.setZero();
  T_map_body_ = tracked.motion.T_map_body;
  stamp_ = tracked.frame->stamp;
  last_landmarks_ = landmark_ids(tracked.associations);
  lost_frames_ = 0;
}

}  // namespace vinebench
