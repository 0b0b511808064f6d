// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/run_record.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace vinebench::harness {
namespace {

constexpr int kDark = 64;
constexpr int kSaturated = 250;
constexpr int kRowStep = 4;

}  // namespace

Brightness brightness_of(const cv::Mat& image) {
  std::array<std::int64_t, 256> counts{};
  for (int y = 0; y < image.rows; y += kRowStep) {
    const auto* row = image.ptr<std::uint8_t>(y);
    const std::uint8_t* end = row + static_cast<std::size_t>(image.cols) * image.elemSize();
    for (; row != end; ++row) ++counts[*row];
  }
  const auto share = [&](int from, int to) {
    const auto total = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
    const auto part = std::accumulate(counts.begin() + from, counts.begin() + to, std::int64_t{0});
    return total > 0 ? static_cast<double>(part) / static_cast<double>(total) : 0;
  };
  return {.dark = share(0, kDark), .saturated = share(kSaturated, 256)};
}

Trajectory true_trajectory(const RunRecord& record) {
  Trajectory trajectory;
  for (const Tick& tick : record.ticks) {
    if (tick.truth.known) trajectory.push_back({tick.stamp, tick.truth.T_world_body});
  }
  return trajectory;
}

Trajectory live_trajectory(const RunRecord& record) {
  Trajectory trajectory;
  for (const Tick& tick : record.ticks) {
    if (is_tracked(tick.estimate)) trajectory.push_back({tick.stamp, *tick.estimate.T_map_body});
  }
  return trajectory;
}

std::vector<double> true_path_lengths(const RunRecord& record) {
  std::vector<double> lengths;
  double length = 0;
  const Truth* last = nullptr;
  for (const Tick& tick : record.ticks) {
    if (tick.truth.known) {
      if (last != nullptr) {
        length += (tick.truth.T_world_body.translation - last->T_world_body.translation).norm();
      }
      last = &tick.truth;
    }
    lengths.push_back(length);
  }
  return lengths;
}

namespace {

void take_poses(const Trajectory& trajectory, std::vector<Tick>& ticks) {
  bool had_pose = false;
  for (Tick& tick : ticks) {
    const auto pose = std::ranges::lower_bound(trajectory, tick.stamp, {}, &StampedPose::stamp);
    if (pose != trajectory.end() && pose->stamp == tick.stamp) {
      tick.estimate.T_map_body = pose->pose;
      tick.estimate.status = TrackingStatus::kTracking;
      had_pose = true;
    } else if (had_pose) {
      tick.estimate.status = TrackingStatus::kLost;
    }
  }
}

}  // namespace

RunRecorder::RunRecorder(Rig rig, std::vector<WorldTag> tags,
                         std::vector<RegisteredTag> told_tags) {
  record_.rig = std::move(rig);
  record_.tags = std::move(tags);
  record_.told_tags = std::move(told_tags);
}

void RunRecorder::on_tick(const Sample& sample, const Estimate& estimate) {
  record_.ticks.push_back(
      {sample.frame.index, sample.frame.stamp, sample.truth, estimate, sample.events});
  record_.ticks.back().truth.path = {};  // many poses, of no use to the judge
  for (const cv::Mat& image : sample.frame.images) {
    record_.ticks.back().delivered.push_back(!image.empty());
    record_.ticks.back().brightness.push_back(brightness_of(image));
  }
}

void RunRecorder::on_finish(const SlamSummary& summary) {
  record_.summary = summary;
  const bool any = std::ranges::any_of(
      record_.ticks, [](const Tick& tick) { return tick.estimate.T_map_body.has_value(); });
  if (!any) take_poses(summary.trajectory, record_.ticks);
}

}  // namespace vinebench::harness
