// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/stereo_calibration.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace vinebench::slam {
namespace {

constexpr unsigned kFirst = 12;  // keyframes
constexpr unsigned kLast = 96;   // keyframes
constexpr int kWindow = 24;      // keyframes
constexpr int kIterations = 20;

/// On clean simulated drives the offsets come out below 0.04 px.
constexpr double kLeast = 0.08;  // px

/// By what share the cost falls where the calibration is off: 4 % and more at half a pixel. Other
/// errors of the model, which it is no remedy for, hide in the offsets too, for 1 % at most.
constexpr double kLeastGain = 0.02;

/// The latest keyframes; the first of them is fixed.
AdjustmentWindow latest(const Map& map) {
  const int count = static_cast<int>(map.keyframes().size());
  AdjustmentWindow window;
  const int first = std::max(0, count - kWindow);
  window.fixed.push_back(first);
  for (int id = first + 1; id < count; ++id) window.moved.push_back(id);
  return window;
}

}  // namespace

bool calibration_due(const Map& map) {
  const auto count = static_cast<unsigned>(map.keyframes().size());
  return count >= kFirst && count <= kLast && count % kFirst == 0 &&
         std::has_single_bit(count / kFirst);
}

std::optional<std::vector<double>> find_disparity_offsets(const Map& map, const EstimatorRig& rig,
                                                          const AdjustmentOptions& options) {
  AdjustmentOptions with_offsets = options;
  with_offsets.iterations = kIterations;
  with_offsets.offsets_unknown = true;
  AdjustmentJob job(map, latest(map), rig, with_offsets);
  const double as_nominal = job.solve();
  job.free_offsets();
  const double as_found = job.solve();
  double farthest = 0;
  for (std::size_t v = 0; v < rig.left_cameras.size(); ++v) {
    const double change = job.disparity_offsets()[v] - rig.left_cameras[v].disparity_offset;
    farthest = std::max(farthest, std::abs(change));
  }
  if (farthest < kLeast || as_nominal - as_found < kLeastGain * as_nominal) return std::nullopt;
  return job.disparity_offsets();
}

}  // namespace vinebench::slam
