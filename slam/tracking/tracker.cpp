// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>

#include "slam/matching/appearance_matcher.h"
#include "slam/matching/landmark_view.h"
#include "slam/matching/match_refiner.h"
#include "slam/matching/projection_matcher.h"
#include "slam/tracking/pose_sampling.h"

namespace vinebench::slam {
namespace {

/// Keyframes nearer than this that look the same way may show the same vines.
constexpr double kNearby = 1.0;                                 // m
constexpr double kSameHeading = 40.0 * std::numbers::pi / 180;  // rad

/// What a pose found after an odometry gap may differ from the dead-reckoned one: this many
/// standard deviations, and what the found one's own error may be.
constexpr double kMaxSigmas = 4;
/// Nine in ten are within this, on three axes together: what is farther must be borne out.
constexpr double kLikelySigmas = 2.5;
constexpr double kPoseNoise = 0.05;     // m
constexpr double kHeadingNoise = 0.05;  // rad

/// Vines this far apart can be exactly alike in what a few dozen features see of them.
constexpr double kLookAlike = 0.5;  // m

/// What no robot's speed changes by faster from one image to the next: what falls.
constexpr double kMaxAcceleration = 10;  // m/s^2

/// Of the landmarks that a pose would have in view, at least this share must be there. After
/// blackouts of 1 to 5 s between rows of plants that repeat, poses that were right found 19 to 27 %
/// of them, wrong ones, with up to 73 inliers, 3 to 4 % (many-rows-short); wrong ones in quick
/// turns with one pair at 10 Hz 5 to 10 %.
constexpr double kMinFound = 0.15;

/// How well a seen pose is known against those of the frames before and after it: better than the
/// map about it is known, which is the same for all of them.
Matrix6d seen_covariance(const Matrix6d& information) {
  constexpr double kPosition = 5e-4;    // m
  constexpr double kRotation = 1.5e-4;  // rad
  constexpr double kWeakest = 1e-2;     // m and rad, where a direction is not held at all
  Matrix6d regular = information;
  regular.diagonal().array() += 1 / (kWeakest * kWeakest);
  Matrix6d covariance = regular.inverse();
  covariance.diagonal().head<3>().array() += kPosition * kPosition;
  covariance.diagonal().tail<3>().array() += kRotation * kRotation;
  return covariance;
}

/// A vote for each keyframe nearby that is turned by at most `turn`, rad.
void vote_nearby(const Map& map, const Pose& T_map_body, double turn, std::vector<int>& votes) {
  for (const Keyframe& keyframe : map.keyframes()) {
    const Pose T_body_key = T_map_body.inverse() * keyframe.T_map_body;
    if (T_body_key.translation.norm() < kNearby && angle_of(T_body_key.rotation) <= turn) {
      ++votes[static_cast<std::size_t>(keyframe.id)];
    }
  }
}

void add_landmarks_of(const Keyframe& keyframe, std::vector<char>& wanted) {
  for (const std::vector<int>& view : keyframe.landmarks) {
    for (const int id : view) {
      if (id >= 0) wanted[static_cast<std::size_t>(id)] = 1;
    }
  }
}

}  // namespace

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
  vote_nearby(map, T_map_body, kSameHeading, votes);
  // Turned about, the back pair sees what the front pair saw.
  const bool none = std::ranges::all_of(votes, [](int vote) { return vote == 0; });
  if (none) vote_nearby(map, T_map_body, std::numbers::pi, votes);
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

void Tracker::start(const Pose& T_map_body, Stamp stamp, bool guessed) {
  T_map_body_ = T_map_body;
  guessed_ = guessed;
  stamp_ = stamp;
  velocity_.setZero();
  velocity_known_ = false;
  last_landmarks_.clear();
  dead_reckoning_.place(T_map_body);
  dead_reckoning_.reset();
}

void Tracker::correct(const Pose& T_map_body) {
  dead_reckoning_.correct(T_map_body * T_map_body_.inverse());
  T_map_body_ = T_map_body;
}

Pose Tracker::predict(const FrameFeatures& frame) const {
  if (const auto inertial = dead_reckoning_.T_map_body()) return *inertial;
  if (dead_reckoning_.active() && frame.wheels) return T_map_body_ * frame.wheels->T_before_now;
  return T_map_body_ * step_of(velocity_ * to_seconds(frame.stamp - stamp_));
}

/// The pose by landmarks near their projection. The radius grows while there are too few matches
/// (paper, Sect. III-A), and while too few of them agree on a pose: where texture is alike all
/// over, a small radius finds enough matches, all wrong.
void Tracker::match_near(const Map& map, const EstimatorRig& rig, const std::vector<int>& landmarks,
                         const Pose& predicted, TrackedFrame& tracked) const {
  ProjectionSearch search{config_.radius, config_.max_hamming, config_.second_best};
  for (int step = 1; step <= config_.radius_steps; ++step) {
    tracked.associations = no_associations(*tracked.frame);
    const int matches = match_by_projection(map, landmarks, *tracked.frame, predicted, rig, search,
                                            tracked.associations);
    search.radius *= config_.radius_growth;
    if (matches < config_.min_matches && step < config_.radius_steps) continue;
    tracked.motion = estimate_motion(map, *tracked.frame, predicted, rig, config_.min_inlier_share,
                                     tracked.associations);
    // The farther from the prediction, the more evidence is asked for.
    if (tracked.motion.inliers >= std::min(step, 2) * config_.min_inliers) return;
  }
}

bool Tracker::match_anywhere(const Map& map, const EstimatorRig& rig, const Pose& predicted,
                             TrackedFrame& tracked) const {
  const std::vector<int> landmarks =
      local_landmarks(map, last_landmarks_, predicted, config_.local_keyframes);
  Associations associations =
      match_by_appearance(map, landmarks, *tracked.frame, config_.max_hamming, config_.second_best);
  const auto sampled = sample_pose(map, *tracked.frame, rig, PoseSampling{}, 0, associations);
  if (!sampled) return false;
  const double reach = std::max(config_.max_speed * to_seconds(tracked.frame->stamp - stamp_),
                                kMaxSigmas * dead_reckoning_.sigma_position());
  if ((sampled->translation - predicted.translation).norm() > reach) return false;
  const MotionEstimate motion =
      estimate_motion(map, *tracked.frame, *sampled, rig, config_.min_inlier_share, associations);
  // Rows look alike: a pose that nothing predicted needs twice the evidence.
  if (motion.inliers < 2 * config_.min_inliers) return false;
  tracked.motion = motion;
  tracked.associations = std::move(associations);
  return true;
}

/// Takes the frame's velocity to be what that of the step to its pose, as far as it is known, has
/// become by its end: it goes on to change as it did since the step before.
void Tracker::update_velocity(TrackedFrame& tracked) const {
  const auto of_step = velocity_to(tracked);
  if (!of_step) return;
  tracked.frame->velocity = *of_step;
  if (!velocity_known_) return;
  const double dt = to_seconds(tracked.frame->stamp - stamp_);
  tracked.frame->velocity += (*of_step - velocity_) * (dt / (dt + step_seconds_));
}

/// Of the step from the last frame. None after an odometry gap: the step also has the gap's error,
/// and the old velocity is truer.
std::optional<Vector6d> Tracker::velocity_to(const TrackedFrame& tracked) const {
  const double dt = to_seconds(tracked.frame->stamp - stamp_);
  if (dt <= 0 || dead_reckoning_.active()) return std::nullopt;
  const Pose step = T_map_body_.inverse() * tracked.motion.T_map_body;
  Vector6d velocity;
  velocity << step.translation / dt, log_so3(step.rotation) / dt;
  return velocity;
}

void Tracker::adjust_motion(const Map& map, const EstimatorRig& rig, TrackedFrame& tracked) const {
  update_velocity(tracked);
  tracked.motion = estimate_motion(map, *tracked.frame, tracked.motion.T_map_body, rig,
                                   config_.min_inlier_share, tracked.associations);
}

void Tracker::refine_on_local_map(const Map& map, const EstimatorRig& rig,
                                  TrackedFrame& tracked) const {
  const std::vector<int> local = local_landmarks(
      map, landmark_ids(tracked.associations), tracked.motion.T_map_body, config_.local_keyframes);
  match_by_projection(map, local, *tracked.frame, tracked.motion.T_map_body, rig,
                      {config_.local_radius, config_.max_hamming, config_.second_best},
                      tracked.associations);
  adjust_motion(map, rig, tracked);
  refine_matches(map, tracked.motion.T_map_body, rig, follow_.refinement, *tracked.frame,
                 tracked.associations);
  adjust_motion(map, rig, tracked);
  follow_patches(map, local, tracked.motion.T_map_body, rig, follow_, *tracked.frame,
                 tracked.associations);
  adjust_motion(map, rig, tracked);
}

TrackedFrame Tracker::track(std::shared_ptr<FrameFeatures> frame, const Map& map,
                            const EstimatorRig& rig) {
  TrackedFrame tracked;
  tracked.frame = std::move(frame);
  dead_reckoning_.arrive(tracked.frame->imu, tracked.frame->wheels, tracked.frame->stamp);
  tracked.frame->velocity = dead_reckoning_.velocity().value_or(velocity_);
  const Pose predicted = predict(*tracked.frame);
  tracked.motion.T_map_body = predicted;
  const bool from_map = dead_reckoning_.active() || last_landmarks_.empty();
  const std::vector<int> landmarks =
      from_map ? local_landmarks(map, last_landmarks_, predicted, config_.local_keyframes)
               : last_landmarks_;
  match_near(map, rig, landmarks, predicted, tracked);
  if (tracked.motion.inliers < 2 * config_.min_inliers) {
    TrackedFrame elsewhere = tracked;
    const bool found = match_anywhere(map, rig, predicted, elsewhere);
    if (found && settle(map, rig, predicted, true, elsewhere)) tracked = std::move(elsewhere);
  }
  // What resembles another place says nothing against the one that was predicted.
  if (tracked.tracked || settle(map, rig, predicted, false, tracked)) {
    accept(tracked);
  } else {
    tracked.associations = no_associations(*tracked.frame);
    reckon(*tracked.frame);
  }
  return tracked;
}

bool Tracker::settle(const Map& map, const EstimatorRig& rig, const Pose& predicted, bool by_looks,
                     TrackedFrame& tracked) const {
  const Vector6d velocity = tracked.frame->velocity;
  if (tracked.motion.inliers >= config_.min_inliers / 2) refine_on_local_map(map, rig, tracked);
  tracked.tracked = is_credible(map, rig, tracked, predicted, by_looks);
  if (tracked.tracked) return true;
  tracked.frame->velocity = velocity;
  for (StereoView& view : tracked.frame->views) {
    view.drop_followed();
    view.placed.clear();
  }
  return false;
}

bool Tracker::may_be_elsewhere(const TrackedFrame& tracked, const Pose& predicted,
                               bool by_looks) const {
  const double jump = (tracked.motion.T_map_body.translation - predicted.translation).norm();
  const double dt = to_seconds(tracked.frame->stamp - stamp_);
  const bool jolted = velocity_known_ && !dead_reckoning_.active() &&
                      jump > kMaxAcceleration * dt * dt + kPoseNoise;
  const double sigma = dead_reckoning_.sigma_position();
  const bool unlikely = dead_reckoning_.active() && jump > kLikelySigmas * sigma + kPoseNoise;
  return guessed_ || jolted || unlikely || (by_looks && jump > kLookAlike) ||
         kMaxSigmas * sigma > kLookAlike;
}

/// Of the landmarks nearby that the pose would have in view, those that are among its inliers.
double Tracker::share_found(const Map& map, const EstimatorRig& rig,
                            const TrackedFrame& tracked) const {
  const std::vector<int> local = local_landmarks(
      map, landmark_ids(tracked.associations), tracked.motion.T_map_body, config_.local_keyframes);
  const Pose T_body_map = tracked.motion.T_map_body.inverse();
  int visible = 0;
  for (const StereoCameraModel& camera : rig.left_cameras) {
    const Pose T_cam_map = camera.T_cam_body * T_body_map;
    for (const int id : local) {
      const Landmark& landmark = map.landmark(id);
      if (!landmark.removed && view_landmark(landmark, T_cam_map, camera.lens)) ++visible;
    }
  }
  return visible > 0 ? static_cast<double>(tracked.motion.inliers) / visible : 0;
}

bool Tracker::is_credible(const Map& map, const EstimatorRig& rig, const TrackedFrame& tracked,
                          const Pose& predicted, bool by_looks) const {
  int matches = 0;
  for (const int n : tracked.motion.matches_per_view) matches += n;
  if (tracked.motion.inliers < config_.min_inliers ||
      tracked.motion.inliers < config_.min_inlier_share * matches) {
    return false;
  }
  if (may_be_elsewhere(tracked, predicted, by_looks) &&
      share_found(map, rig, tracked) < kMinFound) {
    return false;
  }
  if (!dead_reckoning_.active()) return true;
  const Pose off = predicted.inverse() * tracked.motion.T_map_body;
  return off.translation.norm() <= kMaxSigmas * dead_reckoning_.sigma_position() + kPoseNoise &&
         angle_of(off.rotation) <= kMaxSigmas * dead_reckoning_.sigma_rotation() + kHeadingNoise;
}

void Tracker::accept(const TrackedFrame& tracked) {
  if (const auto velocity = velocity_to(tracked)) {
    velocity_ = *velocity;
    velocity_known_ = true;
    step_seconds_ = to_seconds(tracked.frame->stamp - stamp_);
  }
  T_map_body_ = tracked.motion.T_map_body;
  stamp_ = tracked.frame->stamp;
  last_landmarks_ = landmark_ids(tracked.associations);
  dead_reckoning_.see(T_map_body_, seen_covariance(tracked.motion.information));
  dead_reckoning_.reset();
  guessed_ = false;
}

void Tracker::reckon(const FrameFeatures& frame) {
  const double dt = to_seconds(frame.stamp - stamp_);
  const Pose step = dead_reckoning_.advance(frame.wheels, velocity_, dt);
  step_seconds_ = dt;
  T_map_body_ = dead_reckoning_.T_map_body().value_or(T_map_body_ * step);
  stamp_ = frame.stamp;
  if (const auto inertial = dead_reckoning_.velocity()) {
    velocity_ = *inertial;
  } else if (frame.wheels && dt > 0) {
    const Pose& rolled = frame.wheels->T_before_now;
    velocity_ << rolled.translation / dt, log_so3(rolled.rotation) / dt;
  }
  if (dead_reckoning_.is_lost()) velocity_.setZero();
}

}  // namespace vinebench::slam
