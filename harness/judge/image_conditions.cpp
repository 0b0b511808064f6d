// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/image_conditions.h"

#include <algorithm>
#include <cmath>

#include "harness/judge/degraded_segments.h"

namespace vinebench::harness {
namespace {

constexpr double kBlurPixels = 2;      // px
constexpr double kOffsetPixels = 0.5;  // px, beyond what a match is good to
constexpr double kNearThings = 1;      // m, closest usual distance
constexpr double kMostlyDark = 0.95;   // of an image's codes
constexpr double kMuchSaturated = 0.5;
constexpr double kHighGain = 12;  // dB, four times the noise

}  // namespace

ImageConditions::ImageConditions(const RunRecord& record, const Site& site) : record_(record) {
  for (const Site::Object& object : site.objects) {
    if (object.moves) movers_.insert(object.kind);
  }
}

double ImageConditions::pixels_per_second(std::size_t tick, std::size_t camera) const {
  const auto [speed, turn] = true_motion(record_, tick);
  return record_.rig.cameras[camera].model.fx * (turn + speed / kNearThings);
}

const Capture* ImageConditions::capture(std::size_t tick, std::size_t camera) const {
  const std::vector<Capture>& captures = record_.ticks[tick].truth.captures;
  return camera < captures.size() ? &captures[camera] : nullptr;
}

bool ImageConditions::is_dropped(std::size_t tick, std::size_t camera) const {
  const std::vector<bool>& delivered = record_.ticks[tick].delivered;
  return camera < delivered.size() && !delivered[camera];
}

bool ImageConditions::is_blurred(std::size_t tick, std::size_t camera) const {
  const std::vector<double>& times = record_.ticks[tick].truth.blur_time;
  return camera < times.size() && times[camera] * pixels_per_second(tick, camera) >= kBlurPixels;
}

bool ImageConditions::is_rolling(std::size_t tick, std::size_t camera) const {
  const Capture* known = capture(tick, camera);
  return known != nullptr && known->readout_time * pixels_per_second(tick, camera) >= kBlurPixels;
}

bool ImageConditions::is_mistimed(std::size_t tick, std::size_t camera) const {
  const Capture* known = capture(tick, camera);
  if (known == nullptr) return false;
  double seconds = std::abs(known->stamp_error);
  for (const StereoPair& pair : record_.rig.stereo_pairs) {
    const auto left = static_cast<std::size_t>(pair.left);
    const Capture* right = capture(tick, static_cast<std::size_t>(pair.right));
    if (left != camera || right == nullptr) continue;
    seconds = std::max(seconds, std::abs(known->stamp_error - right->stamp_error));
  }
  return seconds * pixels_per_second(tick, camera) >= kOffsetPixels;
}

bool ImageConditions::is_badly_exposed(std::size_t tick, std::size_t camera) const {
  if (is_dropped(tick, camera)) return false;
  const Capture* known = capture(tick, camera);
  if (known != nullptr && known->gain_db >= kHighGain) return true;
  const std::vector<Brightness>& images = record_.ticks[tick].brightness;
  return camera < images.size() &&
         (images[camera].dark >= kMostlyDark || images[camera].saturated >= kMuchSaturated);
}

Occlusion ImageConditions::occlusion(std::size_t tick, std::size_t camera) const {
  const std::vector<Occlusion>& cameras = record_.ticks[tick].truth.occlusion;
  return camera < cameras.size() ? cameras[camera] : Occlusion{};
}

Occlusion ImageConditions::moving(std::size_t tick, std::size_t camera) const {
  const Occlusion all = occlusion(tick, camera);
  Occlusion moving;
  for (const OccluderClass mover : movers_) moving.share(mover) = all.share(mover);
  return moving;
}

}  // namespace vinebench::harness
