// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>

#include "harness/judge/trial.h"
#include "harness/report/run_folder.h"
#include "harness/run/lockstep.h"
#include "harness/run/run_record.h"

namespace vinebench::test {

inline constexpr double kFakeRate = 10;  // frames a second

inline Rig fake_rig() {
  Rig rig;
  rig.name = "fake";
  rig.rate_hz = kFakeRate;
  const PinholeCamera model{.width = 8, .height = 6, .fx = 5, .fy = 5, .cx = 3.5, .cy = 2.5};
  for (const char* name : {"front_left", "front_right", "side"}) {
    rig.cameras.push_back({name, model, Rig::mount({0.1, 0, 0.5}, {0, 0, 0})});
  }
  return rig;
}

/// Once around a circle of 1 m radius in 20 s: 0.314 m/s.
inline Pose circle(Stamp stamp) {
  const double angle = 2 * std::numbers::pi * to_seconds(stamp) / 20;
  return {from_roll_pitch_yaw({0, 0, angle + std::numbers::pi / 2}),
          {std::cos(angle), std::sin(angle), 0}};
}

/// Twenty seconds on the circle; the tag is in view during the first and the last 2 s, cartons
/// cover the front cameras from 8 s to 12 s.
class FakeSource : public FrameSource {
 public:
  explicit FakeSource(int seed = 1, std::int64_t frames = 201) : seed_(seed), frames_(frames) {}

  std::optional<Sample> next() override {
    if (index_ >= frames_) return std::nullopt;
    Sample sample;
    sample.frame.index = index_;
    sample.frame.stamp = stamp_of_frame(index_, kFakeRate);
    for (int camera = 0; camera < 3; ++camera) {
      sample.frame.images.emplace_back(6, 8, CV_8UC3,
                                       cv::Scalar(seed_, camera, double(index_ % 256)));
    }
    const double t = to_seconds(sample.frame.stamp);
    const double share = t >= 8 && t <= 12 ? 0.95 : 0.0;
    sample.truth.T_world_body = circle(sample.frame.stamp);
    sample.truth.occlusion.resize(3);
    for (const std::size_t camera : {0, 1}) {
      sample.truth.occlusion[camera].share(OccluderClass::kCarton) = share;
    }
    if (t <= 2 || t >= 18) sample.truth.visible_tags = {0};
    ++index_;
    return sample;
  }
  std::int64_t size() const override { return frames_; }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return times_; }

 private:
  Rig rig_ = fake_rig();
  int seed_;
  std::int64_t frames_;
  std::int64_t index_ = 0;
  StageTimes times_;
};

/// A SLAM system that returns the true path, modified by `change`.
class FakeSlam : public SlamSystem {
 public:
  using Change = std::function<void(Estimate&)>;
  explicit FakeSlam(Change change = {}) : change_(std::move(change)) {}

  Estimate process(const Frame& frame) override {
    Estimate estimate;
    estimate.stamp = frame.stamp;
    estimate.status = TrackingStatus::kTracking;
    estimate.T_map_body = circle(0).inverse() * circle(frame.stamp);
    estimate.cameras = {{500, 200, 100, 80}, {500, 0, 100, 80}, {}};
    estimate.keyframe = frame.index % 50 == 0;
    if (change_) change_(estimate);
    if (estimate.T_map_body) summary_.trajectory.push_back({frame.stamp, *estimate.T_map_body});
    if (estimate.keyframe) summary_.keyframes.push_back({frame.stamp, *estimate.T_map_body});
    return estimate;
  }
  SlamSummary finish() override {
    summary_.landmarks = 1234;
    return summary_;
  }
  const StageTimes& times() const override { return times_; }

 private:
  Change change_;
  SlamSummary summary_;
  StageTimes times_;
};

/// The true closure between two stamps, off by `offset` metres along x.
inline LoopClosure fake_closure(Stamp earlier, Stamp later, double offset = 0) {
  LoopClosure closure;
  closure.tag_id = 7;
  closure.earlier = earlier;
  closure.later = later;
  closure.T_earlier_later = circle(earlier).inverse() * circle(later) *
                            Pose{Eigen::Quaterniond::Identity(), {offset, 0, 0}};
  return closure;
}

inline Stamp seconds(double s) {
  return from_seconds(s);
}

/// A trial for these fakes: one row, one tag of id 7 beside the start.
inline harness::Trial fake_trial() {
  harness::Trial trial;
  trial.name = "fake";
  trial.seed = 1;
  trial.site.rows = {{{-1, 1.5}, {1, 1.5}}};
  trial.site.vine_spacing = 1;
  trial.site.tags = {
      {"tag36h11", 7, 0.161, {from_roll_pitch_yaw({0, 0, -std::numbers::pi / 2}), {1.3, 0, 0.5}}}};
  trial.site.objects = {{OccluderClass::kCarton, {-1.4, 0}, {0.6, 0.4}}};
  return trial;
}

/// The record of a run of these fakes.
inline harness::RunRecord record_of(FakeSlam::Change change = {}) {
  FakeSource source;
  FakeSlam slam(std::move(change));
  harness::RunRecorder recorder(source.rig(), fake_trial().site.tags);
  harness::run_lockstep(source, slam, {&recorder});
  return recorder.record();
}

/// Substitute for the resolved scenario beside a run's results.
inline constexpr const char* kFakeSettings = "name: \"fake\"\n";

/// A run folder for these fakes.
inline void prepare_fake_folder(const std::filesystem::path& folder) {
  const FolderLock lock =
      harness::prepare_run_folder(folder, "scenario.resolved.yaml", kFakeSettings);
}

}  // namespace vinebench::test
