// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "core/slam_system.h"
#include "core/util/stage_timer.h"
#include "slam/camera/estimator_rig.h"
#include "slam/config.h"
#include "slam/loop/loop_closer.h"
#include "slam/loop/place_loops.h"
#include "slam/map/map.h"
#include "slam/map/trajectory_record.h"
#include "slam/mapping/local_mapper.h"
#include "slam/pose_covariance.h"
#include "slam/recovery.h"
#include "slam/runtime/global_adjuster.h"
#include "slam/runtime/mapping_scheduler.h"
#include "slam/runtime/self_calibration.h"
#include "slam/tracking/frame_report.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// The paper's Fig. 4 from features on: tracking, keyframes, local mapping and loop closing, one
/// after the other for each frame. Knows no images, so that it can be tested without any.
class Pipeline {
 public:
  /// With `one_thread`, local adjustments are solved by the caller; changes no result.
  Pipeline(const SlamConfig& config, const StereoRig& rig, const std::vector<RegisteredTag>& tags,
           bool one_thread = false);
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// Goes on with a map of an earlier run, once a frame has found its place in it. Call before the
  /// first frame.
  void continue_from(Map map);

  Estimate process(const std::shared_ptr<FrameFeatures>& frame);
  SlamSummary finish();

  /// As MappingSystem::supporting_features().
  std::vector<SupportingFeature> supporting_features() const {
    return supporting_.in_images(rig_.rig);
  }

  const Map& map() const { return map_; }
  const EstimatorRig& rig() const { return rig_; }
  StageTimes& times() { return times_; }
  const StageTimes& times() const { return times_; }

 private:
  void join_due_mapping();
  void correct_stereo(FrameFeatures& frame) const;
  TrackedFrame locate(const std::shared_ptr<FrameFeatures>& frame);
  void bring_tags_to_stamp(FrameFeatures& frame) const;
  void gate_tags(TrackedFrame& tracked, Estimate& estimate);
  static void release_images(FrameFeatures& frame);
  void record_tags(const TrackedFrame& tracked);
  void record_pose(const TrackedFrame& tracked, Estimate& estimate);

  TrackedFrame initialise(const std::shared_ptr<FrameFeatures>& frame);
  TrackedFrame relocalise(const std::shared_ptr<FrameFeatures>& frame);
  TrackedFrame track(const std::shared_ptr<FrameFeatures>& frame);
  void find_carried(TrackedFrame& tracked);
  void carry(const Pose& T_map_body, TrackedFrame& tracked);
  void settle_dissent(TrackedFrame& tracked);
  bool wants_new_keyframe(const TrackedFrame& tracked) const;
  void join_mapping(TrackedFrame* tracked = nullptr);
  bool is_live() const { return config_.mapping.schedule == MappingSchedule::kLive; }
  void adjust_globally();
  void adjust_moved_map();
  void start_due_adjustment();
  void join_global_adjustment();
  void map_keyframe(TrackedFrame& tracked, Estimate& estimate);
  void close_loop(int keyframe, Estimate& estimate);
  void close_loop_by_place(int keyframe, Estimate& estimate);
  void take_calibration(Estimate& estimate);
  void believe_gravity();
  void calibrate(Estimate& estimate);
  void use_calibration(const RigCalibration& found);
  Matrix6d covariance(const TrackedFrame& tracked, bool keyframe) const;
  Matrix6d covariance_by(const std::vector<TagSighting>& tags) const;
  TrackingStatus status(const TrackedFrame& tracked) const;

  SlamConfig config_;
  EstimatorRig rig_;
  Map map_;
  Tracker tracker_;
  LocalMapper mapper_;
  MappingScheduler scheduler_;
  LoopCloser loop_closer_;
  std::optional<PlaceLoops> places_;
  Recovery recovery_;
  SelfCalibration calibration_;
  GlobalAdjuster global_adjuster_;  ///< live
  PoseCovariance covariance_;
  StageTimes times_;
  TrajectoryRecord records_;
  SupportingFeatures supporting_;
  double path_length_ = 0;  ///< m
  int closures_ = 0;
  bool started_ = false;
  bool tags_since_adjustment_ = false;  ///< tags were seen after the last global adjustment
};

}  // namespace vinebench::slam
