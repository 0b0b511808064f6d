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

/// Each half of the keyframes must show the same offset, within this and this share of it: what
/// changes on the way is no property of the cameras. Halves of twelve keyframes of simulated drives
/// differ from the whole by up to 0.27 px (csl-1-short, seeds 101 to 103); those of six by more.
constexpr double kHalfNoise = 0.5;  // px
constexpr double kMaxDisagreement = 0.5;

/// No offset is believed that is this many times as large as the rig's accuracy: then more is wrong
/// with the calibration than this one number.
constexpr double kMostSigmas = 3;

/// On clean simulated drives the offsets come out below 0.04 px.
constexpr double kLeast = 0.08;  // px

/// By what share the cost falls where the calibration is off: 4 % and more at half a pixel. Other
/// errors of the model, which it is no remedy for, hide in the offsets too, for 1 % at most.
constexpr double kLeastGain = 0.02;

/// The `count` keyframes before `end`; the first of them is fixed.
AdjustmentWindow keyframes_before(int end, int count) {
  AdjustmentWindow window;
  const int first = std::max(0, end - count);
  window.fixed.push_back(first);
  for (int id = first + 1; id < end; ++id) window.moved.push_back(id);
  return window;
}

struct Adjusted {
  std::vector<double> offsets;  ///< px, of each pair
  double gain = 0;              ///< share of the cost that they take away
};

Adjusted adjust_offsets(const Map& map, const AdjustmentWindow& window, const EstimatorRig& rig,
                        const AdjustmentOptions& options) {
  AdjustmentJob job(map, window, rig, options);
  const double as_nominal = job.solve();
  job.free_offsets();
  const double as_found = job.solve();
  return {job.disparity_offsets(), as_nominal > 0 ? 1 - as_found / as_nominal : 0};
}

/// Whether a part of the drive by itself shows what the whole does.
bool agree(const Adjusted& part, const Adjusted& whole, const EstimatorRig& rig) {
  for (std::size_t v = 0; v < whole.offsets.size(); ++v) {
    const double change = std::abs(whole.offsets[v] - rig.left_cameras[v].disparity_offset);
    const double limit = std::max(kHalfNoise, kMaxDisagreement * change);
    if (std::abs(part.offsets[v] - whole.offsets[v]) > limit) return false;
  }
  return true;
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
  const int end = static_cast<int>(map.keyframes().size());
  const int count = std::min(kWindow, end);
  const Adjusted whole = adjust_offsets(map, keyframes_before(end, count), rig, with_offsets);
  double farthest = 0;
  for (std::size_t v = 0; v < rig.left_cameras.size(); ++v) {
    const double change = whole.offsets[v] - rig.left_cameras[v].disparity_offset;
    farthest = std::max(farthest, std::abs(change));
    const double most = kMostSigmas * rig.noise.disparity_offset_sigma;
    if (std::abs(whole.offsets[v]) > most) return std::nullopt;
  }
  if (farthest < kLeast || whole.gain < kLeastGain) return std::nullopt;
  for (const int part_end : {end - count / 2, end}) {
    const AdjustmentWindow part = keyframes_before(part_end, count / 2);
    if (!agree(adjust_offsets(map, part, rig, with_offsets), whole, rig)) return std::nullopt;
  }
  return whole.offsets;
}

}  // namespace vinebench::slam
