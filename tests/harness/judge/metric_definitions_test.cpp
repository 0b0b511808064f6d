// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// Every metric of metrics.json that follows from trajectories, and every bound, on one drive that
// is made by hand: nine frames, a second apart, straight ahead along x at 0.5 m/s. The definitions
// are those of docs/running.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/config/yaml.h"
#include "harness/judge/bounds.h"
#include "harness/judge/run_report.h"
#include "harness/report/report_json.h"
#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

constexpr double kDriveDegree = std::numbers::pi / 180;
constexpr std::size_t kDriveFrames = 9;
constexpr double kDriveStep = 0.5;   // m a frame
constexpr double kScale = 1.02;      // of the corrected estimate
constexpr double kLiveScale = 1.04;  // of the live one
constexpr double kRoll = 10 * kDriveDegree;
constexpr double kDriveRounding = 1e-9;  // m, deg, shares: of double precision

/// At `x` m along the drive, with roll, pitch and yaw in degrees.
Pose at(double x, double pitch_deg = 0, double yaw_deg = 0) {
  return {from_roll_pitch_yaw({0, pitch_deg * kDriveDegree, yaw_deg * kDriveDegree}), {x, 0, 0}};
}

/// 2 % too long; turned by 3 degrees in frame 2 and -4 in frame 5, pitched by 6 degrees in frame 3.
Trajectory corrected_estimate() {
  Trajectory trajectory;
  for (std::size_t i = 0; i < kDriveFrames; ++i) {
    const double x = kScale * kDriveStep * static_cast<double>(i);
    const double yaw = i == 2 ? 3 : i == 5 ? -4 : 0;
    trajectory.push_back(
        {static_cast<Stamp>(i) * kNanosecondsPerSecond, at(x, i == 3 ? 6 : 0, yaw)});
  }
  return trajectory;
}

LoopClosure closure_with_frame_0(std::size_t later, double off) {
  LoopClosure closure;
  closure.tag_id = -1;  // by appearance
  closure.later = static_cast<Stamp>(later) * kNanosecondsPerSecond;
  closure.T_earlier_later = at(kDriveStep * static_cast<double>(later) + off);
  return closure;
}

/// 4 % too long, with standard deviations of 1 cm and 0.01 rad; dead-reckoned in frame 4, lost in
/// frame 5; a right closure in frame 6 and one that is 0.2 m off in frame 7.
Estimate live_estimate(std::size_t i) {
  Estimate estimate;
  estimate.status = i == 4   ? TrackingStatus::kDeadReckoning
                    : i == 5 ? TrackingStatus::kLost
                             : TrackingStatus::kTracking;
  if (i != 5) estimate.T_map_body = at(kLiveScale * kDriveStep * static_cast<double>(i));
  estimate.covariance = Vector6d::Constant(1e-4).asDiagonal();
  const int inliers = i >= 2 && i <= 6 ? 10 : 100;
  estimate.cameras = {{500, 200, 100, inliers}, {400, 0, 100, inliers}, {}};
  // The map is placed 5 cm aside from frame 6 on.
  if (i >= 6) estimate.T_world_map = Pose{Eigen::Quaterniond::Identity(), {0, 0.03, 0.04}};
  if (i == 6) estimate.loop_closure = closure_with_frame_0(6, 0);
  if (i == 7) estimate.loop_closure = closure_with_frame_0(7, 0.2);
  return estimate;
}

/// Crates cover the front pair in frames 2 to 6; the tag is in view in frames 0, 1, 6, 7 and 8.
RunRecord drive() {
  RunRecord record;
  record.rig = test::fake_rig();
  record.tags = test::fake_trial().site.tags;
  for (std::size_t i = 0; i < kDriveFrames; ++i) {
    Tick tick;
    tick.index = static_cast<std::int64_t>(i);
    tick.stamp = static_cast<Stamp>(i) * kNanosecondsPerSecond;
    tick.truth.T_world_body = at(kDriveStep * static_cast<double>(i));
    tick.truth.occlusion.resize(3);
    for (const std::size_t camera : {0, 1}) {
      const double share = i >= 2 && i <= 6 ? 0.9 : 0;
      tick.truth.occlusion[camera].share(OccluderClass::kCrate) = share;
    }
    if (i <= 1 || i >= 6) tick.truth.visible_tags = {0};
    tick.estimate = live_estimate(i);
    record.ticks.push_back(tick);
  }
  TagSighting seen;
  seen.family = record.tags[0].family;
  seen.id = record.tags[0].id;
  record.ticks[0].estimate.tags = {seen};
  record.ticks[5].events = {{"picture_unreadable", "side", ""}, {"picture_unreadable", "side", ""}};
  record.summary = {corrected_estimate(), {}, 12, {}};
  record.summary.keyframes = {record.summary.trajectory.front(), record.summary.trajectory.back()};
  // The system has its map rolled by 10 degrees about the drive's axis, and 5 cm aside.
  record.summary.T_world_map = Pose{from_roll_pitch_yaw({kRoll, 0, 0}), {0, 0.03, 0.04}};
  return record;
}

Json metrics_of_drive() {
  Trial trial = test::fake_trial();
  trial.route_end = {4.03, 0.04};  // the rover ends at (4, 0)
  trial.expectations.blind = {.cameras = {"front_left", "front_right"},
                              .inliers_drop = std::nullopt};
  return to_json(judge(drive(), trial));
}

using MetricValues = std::map<std::string, double>;

/// x_i = 0.5 i m, of mean 2 m; sums of squares: (x - 2)^2 15 m^2, x^2 51 m^2.
MetricValues position_errors() {
  const double spread = std::sqrt(15.0 / 9), length = std::sqrt(51.0 / 9);
  // Without frames 4 and 5: the sum of i is 27, of i^2 163, of seven frames.
  const double live_spread = kDriveStep * std::sqrt(163.0 / 7 - std::pow(27.0 / 7, 2));
  // Segments of two frames, of which 0, 1, 4 and 6 begin without an error of orientation; a turn
  // by a takes the end of 1.02 m to sqrt(1.02^2 + 1 - 2 * 1.02 cos(a)) from that of 1 m.
  const auto segment = [](double degrees) {
    return std::sqrt(1.02 * 1.02 + 1 - 2.04 * std::cos(degrees * kDriveDegree));
  };
  return {
      // Aligned, the centres agree, and errors are 2 % (4 %) of the distance from the centre.
      {"/ate_rmse_m", 0.02 * spread},
      {"/ate_max_m", 0.02 * 2},
      {"/ate_live_rmse_m", 0.04 * live_spread},
      // Aligned by the first pose, they are 2 % of the distance from the start, 4 m in the end.
      {"/ate_origin_rmse_m", 0.02 * length},
      {"/worst_frame/error_m", 0.08},
      {"/worst_frame/t", 8},
      {"/rpe_trans_percent", 100 * (4 * 0.02 + segment(3) + segment(6) + segment(4)) / 7},
      // The map's roll moves nothing on its axis; its offset of 5 cm is across it.
      {"/ate_world_rmse_m", std::sqrt(0.0004 * 51 / 9 + 0.0025)},
      // Of nine, ordered, 95 % is 6 tenths of the way from the eighth (3.5 m) to the ninth (4 m).
      {"/ate_world_p95_m", 0.4 * std::hypot(0.07, 0.05) + 0.6 * std::hypot(0.08, 0.05)},
      // Of frames 6 to 8: 4 % of 3, 3.5 and 4 m along the drive.
      {"/ate_world_live_rmse_m", std::sqrt((0.12 * 0.12 + 0.14 * 0.14 + 0.16 * 0.16) / 3 + 0.0025)},
      // Before frame 6, the last pose by cameras is that of frame 3: 1.5 m, 4 % too long.
      {"/drift_m", 0.06},
      {"/drift_percent", 4},
      {"/end_error_m", 0.05},
  };
}

/// Root mean square over the nine frames, degrees.
double rms_deg(const std::vector<double>& errors_rad) {
  double squares = 0;
  for (const double error : errors_rad) squares += error * error;
  return std::sqrt(squares / kDriveFrames) / kDriveDegree;
}

MetricValues orientation_errors_of_drive() {
  // In the world all is rolled: an axis (cos a, sin a, 0) becomes (cos a, sin a cos r, ...), and
  // the pitched one, (cos p, 0, -sin p), becomes (cos p, sin p sin r, ...).
  const auto rolled = [](double yaw_deg) {
    return std::atan(std::tan(yaw_deg * kDriveDegree) * std::cos(kRoll));
  };
  const double pitched = std::atan(std::tan(6 * kDriveDegree) * std::sin(kRoll));
  // The vertical: by the roll, and in frame 3 by roll and pitch together.
  std::vector<double> tilts(kDriveFrames, kRoll);
  tilts[3] = std::acos(std::cos(kRoll) * std::cos(6 * kDriveDegree));
  return {{"/heading_rmse_deg", std::sqrt((9 + 16) / 9.0)},
          {"/heading_max_deg", 4},
          {"/tilt_rmse_deg", std::sqrt(36 / 9.0)},
          {"/tilt_max_deg", 6},
          {"/heading_world_rmse_deg", rms_deg({rolled(3), rolled(-4), pitched})},
          {"/tilt_world_rmse_deg", rms_deg(tilts)}};
}

MetricValues counts() {
  return {{"/frames", 9},
          {"/coverage", 7.0 / 9},  // all but the dead-reckoned and the lost one
          {"/lost_frames", 2},
          {"/losses", 1},
          // Live errors are 0.02 i m, 2 i standard deviations: 4 i^2, of which i = 0, 1 are below
          // 12.59. The dead-reckoned pose has a covariance too, and counts.
          {"/nees_mean", 4 * 179.0 / 8},
          {"/nees_within_95", 2.0 / 8},
          {"/nees_left_out", 0},
          {"/loop_closures/correct", 1},
          {"/loop_closures/wrong", 1},
          // The tag is seen again after 5 s and 2.5 m, for 2 s; neither closure is by it.
          {"/loop_closures/missed", 1},
          {"/loop_returns", 1},
          {"/keyframes", 2},
          {"/landmarks", 12},
          {"/features/front_left", 500},
          {"/features/front_right", 400},
          {"/features/side", 0},
          {"/inliers/front_left", (4 * 100 + 5 * 10) / 9.0},
          {"/inliers/front_right", (4 * 100 + 5 * 10) / 9.0},
          {"/inliers/side", 0},
          {"/input_faults/picture_unreadable", 2},
          {"/occlusion/front_left/crate", 5 * 0.9 / 9},
          {"/occlusion/front_right/crate", 5 * 0.9 / 9},
          {"/blind/seconds", 4},  // frames 2 to 6
          {"/blind/metres", 2},
          {"/blind/lost_frames", 2},
          {"/blind/inliers_clear", 200},
          {"/blind/inliers_blind", 20},
          {"/blind/inliers_drop", 0.9}};
}

MetricValues all_values() {
  MetricValues all = position_errors();
  all.merge(orientation_errors_of_drive());
  all.merge(counts());
  return all;
}

/// What follows from no trajectory, or is tested by itself (findings/, verdict, cost of a run).
bool is_no_metric_of_the_drive(const std::string& pointer) {
  for (const char* part : {"/scenario", "/seed", "/version", "/real_time_factor", "/wall_seconds",
                           "/cpu_seconds", "/timing_ms", "/peak_rss_mib", "/hash", "/expectations",
                           "/error_patterns", "/discrepancies"}) {
    if (pointer.starts_with(part)) return true;
  }
  return false;
}

TEST(MetricDefinitionsTest, EveryMetricIsWhatTheDriveSays) {
  const Json metrics = metrics_of_drive();
  for (const auto& [pointer, value] : all_values()) {
    const Json::json_pointer place(pointer);
    ASSERT_TRUE(metrics.contains(place)) << pointer;
    ASSERT_TRUE(metrics.at(place).is_number()) << pointer;
    EXPECT_NEAR(metrics.at(place).get<double>(), value, kDriveRounding) << pointer;
  }
  EXPECT_EQ(metrics.at("blind").at("occluder"), "crate");
}

// A new metric comes with a value that is derived here.
TEST(MetricDefinitionsTest, NoMetricIsLeftOut) {
  const MetricValues values = all_values();
  const Json metrics = metrics_of_drive().flatten();
  for (const auto& [pointer, value] : metrics.items()) {
    if (is_no_metric_of_the_drive(pointer) || pointer == "/blind/occluder") continue;
    EXPECT_TRUE(values.contains(pointer)) << pointer;
  }
}

// Each bound holds at the derived value with 0.1 % to spare, and fails with 0.1 % too little;
// counts hold at the value and fail one beside it.
TEST(MetricDefinitionsTest, EveryBoundIsOnItsMetric) {
  const MetricValues values = all_values();
  Trial trial = test::fake_trial();
  trial.route_end = {4.03, 0.04};
  const RunResults results = measure(drive(), trial);
  for (const Bound& bound : bounds()) {
    ASSERT_TRUE(values.contains(bound.metric)) << bound.key;
    const double value = values.at(bound.metric);
    const auto holds = [&](double limit) {
      YamlDocument document;
      document.set(bound.key, fmt::format("{}", limit));
      return all_hold(check_expectations(document.read<Expectations>(), results));
    };
    const bool count = bound.spread == Spread::kCount;
    const double slack = (bound.at_least ? -1 : 1) * (count ? 1 : 1e-3 * value);
    EXPECT_TRUE(holds(count ? value : value + slack)) << bound.key;
    EXPECT_FALSE(holds(value - slack)) << bound.key;
    const bool minimum = std::string(bound.key).find("_min") != std::string::npos;
    EXPECT_EQ(bound.at_least, minimum) << bound.key;
  }
}

}  // namespace
}  // namespace vinebench::harness
