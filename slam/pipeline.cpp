// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/pipeline.h"

#include <algorithm>
#include <utility>

#include "core/geometry/step_covariance.h"
#include "core/util/error.h"
#include "slam/frame/measurements.h"
#include "slam/loop/loop_correction.h"
#include "slam/loop/tag_survey.h"
#include "slam/tags/tag_sightings.h"
#include "slam/tags/tag_times.h"
#include "slam/tracking/keyframe_selector.h"

namespace vinebench::slam {
namespace {

/// Of the first pose where it is the map's origin: nothing but invertible.
Matrix6d covariance_of_origin() {
  return isotropic_covariance(1e-6, 1e-6);
}

/// Whether tags tell by their surveys how the map lies, and none of them exactly.
bool several_surveys(const Map& map) {
  return std::ranges::count_if(map.tags(), [](const MapTag& t) { return t.survey.has_value(); }) >
         1;
}

}  // namespace

Pipeline::Pipeline(const SlamConfig& config, const StereoRig& rig,
                   const std::vector<RegisteredTag>& tags, bool one_thread)
    : config_(config),
      rig_(rig, config.features, config.refinement),
      map_(config.features.scale),
      tracker_({config.tracking, config.dead_reckoning, config.refinement, config.stereo,
                inertial_noise(config.inertial, rig.imu), config.wheels}),
      mapper_({config.mapping, config.refinement.enabled, config.tracking.max_hamming,
               config.tracking.second_best, config.stereo.min_depth,
               config.stereo.far_depth_baselines, config.loop.corner_sigma,
               inertial_noise(config.inertial, rig.imu)}),
      scheduler_(config.mapping, one_thread),
      loop_closer_({config.loop, config.tags.size, config.mapping.global_iterations,
                    inertial_noise(config.inertial, rig.imu)},
                   rig_.tag_cameras, tags),
      recovery_(tracker_, loop_closer_, rig_, map_),
      calibration_({config.calibration, config.stereo.calibration_sigma,
                    config.stereo.self_calibration, is_live()},
                   rig_),
      covariance_(is_live()) {
  rig_.wheels = config.dead_reckoning.wheels;
  rig_.noise.loss = config.loss;
  if (config.places) places_.emplace(*config.places);
}

void Pipeline::continue_from(Map map) {
  if (!map_.keyframes().empty()) fail("a map can be loaded before the first frame only");
  map_ = std::move(map);
  if (!map_.calibration().empty()) rig_ = rig_.with_calibration(map_.calibration());
  calibration_.begin(map_.keyframes().size());
  loop_closer_.gates().take_over(map_);
}

Estimate Pipeline::process(const std::shared_ptr<FrameFeatures>& frame) {
  global_adjuster_.wait_for_copy();
  join_due_mapping();
  correct_stereo(*frame);
  TrackedFrame tracked = locate(frame);
  bring_tags_to_stamp(*frame);
  Estimate estimate = report_of(tracked, rig_.rig, status(tracked));
  gate_tags(tracked, estimate);
  if (wants_new_keyframe(tracked)) map_keyframe(tracked, estimate);
  release_images(*frame);
  record_tags(tracked);
  record_pose(tracked, estimate);
  supporting_.keep(tracked);
  start_due_adjustment();
  return estimate;
}

void Pipeline::bring_tags_to_stamp(FrameFeatures& frame) const {
  for (TagSighting& tag : frame.tags) {
    tag.late += rig_.tag_time(tag.camera);
    bring_to_stamp(frame.velocity, rig_.tag_cameras, tag);
  }
}

void Pipeline::join_due_mapping() {
  scheduler_.tick();
  if (scheduler_.due()) join_mapping();
  if (global_adjuster_.done() && !scheduler_.busy()) join_global_adjustment();
}

/// Depths as self-calibration has found the pairs to measure.
void Pipeline::correct_stereo(FrameFeatures& frame) const {
  for (std::size_t v = 0; v < frame.views.size(); ++v) {
    correct_depths(rig_.left_cameras[v], config_.stereo.max_depth_baselines, frame.views[v]);
    reach_farther(rig_.left_cameras[v], config_.stereo, frame.views[v]);
  }
}

TrackedFrame Pipeline::locate(const std::shared_ptr<FrameFeatures>& frame) {
  if (started_) return track(frame);
  const bool begins = map_.keyframes().empty();
  TrackedFrame tracked = begins ? initialise(frame) : relocalise(frame);
  if (tracked.tracked) recovery_.tracked(frame->stamp);
  return tracked;
}

TrackedFrame Pipeline::relocalise(const std::shared_ptr<FrameFeatures>& frame) {
  const ScopedTimer timer(times_, "relocalisation");
  TrackedFrame tracked = recovery_.relocalise(frame);
  started_ = tracked.tracked;
  return tracked;
}

/// Goes on where a tag says that the body was carried to.
void Pipeline::find_carried(TrackedFrame& tracked) {
  const auto T_map_body = recovery_.carried_to(tracked, path_length_);
  if (T_map_body) carry(*T_map_body, tracked);
}

void Pipeline::carry(const Pose& T_map_body, TrackedFrame& tracked) {
  if (scheduler_.busy()) join_mapping(&tracked);
  records_.withdraw_reckoned(recovery_.move_to(T_map_body, tracked));
  global_adjuster_.outdate();
}

/// Leaves the frame the sightings that are to be believed.
void Pipeline::gate_tags(TrackedFrame& tracked, Estimate& estimate) {
  if (!tracked.tracked) return;
  find_carried(tracked);
  estimate.rejected_tags =
      loop_closer_.gates().gate(*tracked.frame, tracked.motion.T_map_body, path_length_, map_);
  if (loop_closer_.gates().has_dissent()) settle_dissent(tracked);
}

void Pipeline::settle_dissent(TrackedFrame& tracked) {
  if (scheduler_.busy()) join_mapping(&tracked);
  const Pose T_map_body = tracked.motion.T_map_body;
  const std::optional<Pose> T_map_world = map_.world();
  if (const auto to = loop_closer_.gates().settle_dissent(T_map_body, map_)) carry(*to, tracked);
  if (!T_map_world || T_map_world->translation == map_.world()->translation) return;
  global_adjuster_.outdate();
  // Poses are told in the map: it moves, so that the world is where it was.
  const Pose T_new_old = keep_world(map_, *T_map_world);
  tracker_.correct(T_new_old * tracker_.T_map_body());
  tracked.motion.T_map_body = T_new_old * T_map_body;
  believe_gravity();
}

void Pipeline::release_images(FrameFeatures& frame) {
  frame.pyramids.clear();
  frame.right_pyramids.clear();
}

void Pipeline::record_tags(const TrackedFrame& tracked) {
  if (!tracked.tracked) return;
  const bool placed = map_.world().has_value();
  loop_closer_.record(*tracked.frame, tracker_.T_map_body(), path_length_, map_);
  if (map_.world().has_value() != placed) global_adjuster_.outdate();
}

/// Keeps the frame's pose against the latest keyframe, and reports it.
void Pipeline::record_pose(const TrackedFrame& tracked, Estimate& estimate) {
  if (!tracked.tracked && estimate.status != TrackingStatus::kDeadReckoning) return;
  records_.add(estimate.stamp, map_.keyframes().back(), tracker_.T_map_body(), !tracked.tracked);
  estimate.T_map_body = tracker_.T_map_body();
  estimate.covariance = covariance(tracked, estimate.keyframe);
  if (const auto T_map_world = world_by_tags(map_)) estimate.T_world_map = T_map_world->inverse();
}

SlamSummary Pipeline::finish() {
  join_mapping();
  global_adjuster_.wait_for_copy();
  while (global_adjuster_.busy()) {
    join_global_adjustment();
    start_due_adjustment();
  }
  calibration_.finish();
  const auto calibration = calibration_.latest();
  if (calibration) use_calibration(*calibration);
  if (tags_since_adjustment_ || calibration) {
    const ScopedTimer timer(times_, "global adjustment");
    loop_closer_.adjust_globally(rig_, map_);
    tags_since_adjustment_ = false;
  }
  SlamSummary summary;
  summary.trajectory = records_.trajectory(map_);
  for (const Keyframe& keyframe : map_.keyframes()) {
    if (keyframe.inherited()) continue;
    summary.keyframes.push_back({keyframe.frame->stamp, keyframe.T_map_body});
  }
  summary.landmarks = map_.count_landmarks(config_.mapping.min_observations);
  if (map_.world()) summary.T_world_map = map_.world()->inverse();
  return summary;
}

Matrix6d Pipeline::covariance(const TrackedFrame& tracked, bool keyframe) const {
  ErrorOfImageTimes times;
  if (tracked.tracked) times = error_of_image_times(*tracked.frame, tracked.associations, rig_);
  if (keyframe) return covariance_.of_keyframe(calibration_.error(), times);
  const Pose T_last_now = map_.keyframes().back().T_map_body.inverse() * tracker_.T_map_body();
  const Matrix6d seen = covariance_.of_frame(T_last_now, tracked, calibration_.error(), times);
  return tracked.tracked ? seen : seen + tracker_.dead_reckoning().covariance();
}

/// Of the body's pose by these tags: their surveys, their corners, and how the camera of the first
/// of them is mounted, if it was told how well that is known.
Matrix6d Pipeline::covariance_by(const std::vector<TagSighting>& tags) const {
  const Matrix6d by_corners = loop_closer_.gates().localisation_covariance(tags);
  const CalibrationConfig& told = config_.calibration;
  if (!is_accuracy_told(told, config_.stereo.calibration_sigma)) return by_corners;
  const Matrix6d of_camera = isotropic_covariance(told.tag_camera_position,
                                                  told.tag_camera_rotation_deg * kRadiansPerDegree);
  const auto camera = static_cast<std::size_t>(tags.front().camera);
  return by_corners +
         carry_covariance(of_camera, rig_.tag_cameras.cameras[camera].T_body_cam.inverse());
}

/// The first frame with enough stereo points is the map's first keyframe. A registered tag in it
/// makes the map's frame the world's; without one the body is at the origin.
TrackedFrame Pipeline::initialise(const std::shared_ptr<FrameFeatures>& frame) {
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.associations = no_associations(*frame);
  for (std::size_t v = 0; v < frame->views.size(); ++v) {
    const StereoView& view = frame->views[v];
    const int points = count_with_depth(view.stereo);
    tracked.motion.matches_per_view.push_back(points);
    tracked.motion.inliers_per_view.push_back(points);
    tracked.motion.inliers += points;
  }
  tracked.tracked = sees_well(*frame);
  if (tracked.tracked) {
    const std::optional<Pose> by_tag = loop_closer_.gates().world_pose(frame->tags);
    tracked.motion.T_map_body = by_tag.value_or(Pose{});
    tracker_.start(tracked.motion.T_map_body, frame->stamp);
    covariance_.begin(by_tag ? covariance_by(frame->tags) : covariance_of_origin());
  }
  return tracked;
}

TrackedFrame Pipeline::track(const std::shared_ptr<FrameFeatures>& frame) {
  const ScopedTimer timer(times_, "tracking");
  const Pose before = tracker_.T_map_body();
  TrackedFrame tracked = tracker_.track(frame, map_, rig_);
  if (!tracked.tracked && recovery_.find_again(tracked)) {
    records_.withdraw_reckoned(map_.keyframes().back().id);
  }
  if (tracked.tracked) {
    recovery_.tracked(frame->stamp);
  } else {
    recovery_.restart_map(tracked, path_length_);
  }
  path_length_ += (tracker_.T_map_body().translation - before.translation).norm();
  return tracked;
}

TrackingStatus Pipeline::status(const TrackedFrame& tracked) const {
  if (tracked.tracked) return TrackingStatus::kTracking;
  if (!started_) return TrackingStatus::kInitializing;
  return tracker_.dead_reckoning().is_lost() ? TrackingStatus::kLost
                                             : TrackingStatus::kDeadReckoning;
}

bool Pipeline::wants_new_keyframe(const TrackedFrame& tracked) const {
  if (!tracked.tracked) return false;
  if (!started_ || tracked.link) return true;
  // Live, a robot's tracking waits for the mapping before only when it would soon be lost.
  const bool waits = !is_live() || tracked.motion.inliers < config_.keyframes.min_inliers / 2 ||
                     is_overdue(tracked, map_, config_.keyframes);
  if (scheduler_.busy() && !waits) return false;
  if (is_covered(tracked, map_, config_.keyframes)) {
    return loop_closer_.sees_loop(*tracked.frame, path_length_);
  }
  return sees_tag_from_elsewhere(tracked, map_) ||
         loop_closer_.sees_loop(*tracked.frame, path_length_) ||
         wants_keyframe(tracked, map_, config_.keyframes);
}

/// Takes over what local mapping found; the latest poses move with it.
void Pipeline::join_mapping(TrackedFrame* tracked) {
  if (tracked != nullptr && is_live()) scheduler_.hasten();
  const Pose T_new_old = scheduler_.join(map_, times_);
  tracker_.correct(T_new_old * tracker_.T_map_body());
  if (tracked != nullptr) tracked->motion.T_map_body = T_new_old * tracked->motion.T_map_body;
}

/// At once in lockstep; live, beside tracking, from the frame's end on.
void Pipeline::adjust_globally() {
  if (is_live()) {
    global_adjuster_.want();
  } else {
    loop_closer_.adjust_globally(rig_, map_);
  }
}

/// Live, after a loop moved the map: what is under way is of before.
void Pipeline::adjust_moved_map() {
  global_adjuster_.outdate();
  adjust_globally();
}

/// Nothing else changes the map until the next frame.
void Pipeline::start_due_adjustment() {
  if (global_adjuster_.due()) global_adjuster_.start(loop_closer_, rig_, map_);
}

/// Takes over what an adjustment beside tracking found; the latest poses move with it.
void Pipeline::join_global_adjustment() {
  if (const std::optional<Pose> T_new_old = global_adjuster_.join(map_, times_)) {
    tracker_.correct(*T_new_old * tracker_.T_map_body());
    believe_gravity();
    covariance_.join();
  }
}

void Pipeline::map_keyframe(TrackedFrame& tracked, Estimate& estimate) {
  if (scheduler_.busy()) join_mapping(&tracked);
  const bool loop = started_ && loop_closer_.sees_loop(*tracked.frame, path_length_);
  if (started_) {
    const Pose T_last_now =
        map_.keyframes().back().T_map_body.inverse() * tracked.motion.T_map_body;
    covariance_.add_keyframe(T_last_now, tracked, calibration_.drift());
  }
  const int id = mapper_.insert(tracked, rig_, map_);
  map_.keyframe(id).link = tracked.link;
  map_.keyframe(id).motion = tracker_.take_motion();
  map_.gravity() = tracker_.dead_reckoning().gravity();
  const bool tied = closures_ > 0 || several_surveys(map_);
  tags_since_adjustment_ |= tied && !tracked.frame->tags.empty();
  if (loop) close_loop(id, estimate);
  if (places_ && !tracked.link) close_loop_by_place(id, estimate);
  if (started_ && !tracked.link) {
    calibrate(estimate);
    const ScopedTimer timer(times_, "local mapping");
    mapper_.extend(id, rig_, map_);
    scheduler_.start(mapper_.local_adjustment(id, map_, rig_), id, map_);
    if (scheduler_.due()) join_mapping();
  }
  tracker_.correct(map_.keyframe(id).T_map_body);
  tracker_.expect(landmark_ids(map_.keyframe(id).landmarks));
  estimate.keyframe = true;
  started_ = true;
}

void Pipeline::close_loop(int keyframe, Estimate& estimate) {
  const ScopedTimer timer(times_, "global adjustment");
  take_calibration(estimate);
  estimate.loop_closure = loop_closer_.close(keyframe, path_length_, rig_, map_, !is_live());
  if (is_live()) adjust_moved_map();
  believe_gravity();
  const Matrix6d of_tags = covariance_by(map_.keyframe(keyframe).frame->tags);
  // Of one tag seen twice the survey's error is the same; another's is new.
  if (!estimate.loop_closure->covariance && several_surveys(map_)) {
    covariance_.close_besides(of_tags);
  } else {
    covariance_.close(of_tags);
  }
  ++closures_;
  tags_since_adjustment_ = false;
}

/// Before a loop is closed.
void Pipeline::take_calibration(Estimate& estimate) {
  if (const auto latest = calibration_.latest()) {
    use_calibration(*latest);
    estimate.calibration = *latest;
  }
}

void Pipeline::close_loop_by_place(int keyframe, Estimate& estimate) {
  const ScopedTimer timer(times_, "places");
  const Matrix6d now = covariance_.of_keyframe(calibration_.error());
  const auto found = places_->look(keyframe, path_length_, now, map_, rig_);
  if (!found || estimate.loop_closure) return;
  take_calibration(estimate);
  estimate.loop_closure = loop_closer_.close(*found, keyframe, mapper_, rig_, map_, !is_live());
  if (is_live()) adjust_moved_map();
  believe_gravity();
  const Matrix6d by_place =
      carry_covariance(found->earlier_covariance, estimate.loop_closure->T_earlier_later) +
      found->covariance;
  if (by_place.trace() < now.trace()) covariance_.close(by_place);
  ++closures_;
  tags_since_adjustment_ = false;
}

/// As a global adjustment found it.
void Pipeline::believe_gravity() {
  if (map_.gravity()) tracker_.believe_gravity(map_.gravity()->gravity);
}

/// Makes good an error of the rig's calibration, in the map and from here on.
void Pipeline::calibrate(Estimate& estimate) {
  const auto found = calibration_.after_keyframe(map_, rig_, mapper_.adjustment_options(), times_);
  if (!found) return;
  const ScopedTimer timer(times_, "calibration");
  use_calibration(*found);
  adjust_globally();
  believe_gravity();
  estimate.calibration = *found;
}

void Pipeline::use_calibration(const RigCalibration& found) {
  const EstimatorRig before = std::exchange(rig_, rig_.with_calibration(found));
  map_.calibration() = found;
  for (const int camera : rig_.rig.tag_cameras) {
    const double later = rig_.tag_time(camera) - before.tag_time(camera);
    take_tags_later(camera, later, rig_.tag_cameras, map_);
  }
}

}  // namespace vinebench::slam
