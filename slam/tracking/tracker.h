// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"
#include "slam/matching/patch_follower.h"
#include "slam/odometry/dead_reckoning.h"
#include "slam/optimisation/motion_only_ba.h"
#include "slam/tracking/tracking_config.h"

namespace vinebench::slam {

/// What Tracker is set by.
struct TrackerSettings {
  TrackingConfig tracking;
  DeadReckoningConfig dead_reckoning;
  RefinementConfig refinement;
  StereoConfig stereo;
  std::optional<InertialNoise> inertial{};    ///< of a unit that takes part
  std::optional<WheelFusionConfig> wheels{};  ///< that take part beside it
};

/// What tracking made of one frame.
struct TrackedFrame {
  std::shared_ptr<FrameFeatures> frame;
  bool tracked = false;
  /// Nothing ties this frame to the map but dead reckoning; it restarts the map.
  std::optional<OdometryLink> link;
  MotionEstimate motion;
  Associations associations;  ///< inliers only
};

/// Finds the body's pose frame by frame: constant-velocity prediction, landmarks projected into
/// every camera, motion-only bundle adjustment.
class Tracker {
 public:
  explicit Tracker(const TrackerSettings& settings)
      : config_(settings.tracking),
        follow_{settings.refinement, settings.stereo},
        dead_reckoning_(settings.dead_reckoning, settings.inertial, settings.wheels) {}

  /// Starts at a pose, standing still. A pose that is `guessed`, by the looks of the place, must be
  /// borne out by most of what the map has there.
  void start(const Pose& T_map_body, Stamp stamp, bool guessed = false);

  /// Tracks the next frame against the map. Where that fails the pose is dead-reckoned; sight that
  /// comes back must agree with that within its uncertainty, and where that spans several vines,
  /// which look alike, with what else the map has in view.
  TrackedFrame track(std::shared_ptr<FrameFeatures> frame, const Map& map, const EstimatorRig& rig);

  /// Takes over a pose that something else knows better (loop closing, a tag), moving what the
  /// prediction rests on with it.
  void correct(const Pose& T_map_body);

  /// What an inertial unit measured since the last keyframe; call it with each.
  std::optional<PreintegratedMotion> take_motion() { return dead_reckoning_.take_motion(); }

  /// The map's gravity as something else knows it better, m/s^2.
  void believe_gravity(const Eigen::Vector3d& gravity) { dead_reckoning_.believe_gravity(gravity); }

  /// The landmarks to look for first in the next frame, ascending: those of a new keyframe.
  void expect(std::vector<int> landmarks) { last_landmarks_ = std::move(landmarks); }

  /// The last frame's pose, tracked or dead-reckoned.
  const Pose& T_map_body() const { return T_map_body_; }
  const DeadReckoning& dead_reckoning() const { return dead_reckoning_; }

 private:
  Pose predict(const FrameFeatures& frame) const;
  void match_near(const Map& map, const EstimatorRig& rig, const std::vector<int>& landmarks,
                  const Pose& predicted, TrackedFrame& tracked) const;
  /// Matches by appearance alone where the prediction led nowhere: after a start, a jolt or a gap.
  /// False where that finds no pose either.
  bool match_anywhere(const Map& map, const EstimatorRig& rig, const Pose& predicted,
                      TrackedFrame& tracked) const;
  /// Matches, places and follows the landmarks nearby, each round from a better pose.
  void refine_on_local_map(const Map& map, const EstimatorRig& rig, TrackedFrame& tracked) const;
  /// Refines a pose with its matches and says whether it is to be believed; where it is not, the
  /// frame is as it was before.
  bool settle(const Map& map, const EstimatorRig& rig, const Pose& predicted, bool by_looks,
              TrackedFrame& tracked) const;
  void update_velocity(TrackedFrame& tracked) const;
  std::optional<Vector6d> velocity_to(const TrackedFrame& tracked) const;
  void adjust_motion(const Map& map, const EstimatorRig& rig, TrackedFrame& tracked) const;
  /// Whether the body may be so far from where it is thought to be that vines there look alike, or
  /// would have had to get there faster than anything moves.
  bool may_be_elsewhere(const TrackedFrame& tracked, const Pose& predicted, bool by_looks) const;
  double share_found(const Map& map, const EstimatorRig& rig, const TrackedFrame& tracked) const;
  bool is_credible(const Map& map, const EstimatorRig& rig, const TrackedFrame& tracked,
                   const Pose& predicted, bool by_looks) const;
  void accept(const TrackedFrame& tracked);
  void reckon(const FrameFeatures& frame);

  TrackingConfig config_;
  FollowSettings follow_;
  Pose T_map_body_;
  Stamp stamp_ = 0;
  /// Of the body in its own frame over the last step, m/s and rad/s.
  Vector6d velocity_ = Vector6d::Zero();
  double step_seconds_ = 0;
  std::vector<int> last_landmarks_;  ///< seen in the frame before, ascending
  DeadReckoning dead_reckoning_;     ///< the odometry gap, while there is one
  bool velocity_known_ = false;      ///< a frame was seen after the start
  bool guessed_ = false;             ///< the pose, by the looks of the place alone
};

/// Ids of landmarks that a frame may see: those of the keyframes that share most of `seen`, and of
/// their covisible ones, and of those made nearby looking the same way, or any way if there are no
/// others; ascending.
std::vector<int> local_landmarks(const Map& map, const std::vector<int>& seen,
                                 const Pose& T_map_body, int at_most_keyframes);

}  // namespace vinebench::slam
