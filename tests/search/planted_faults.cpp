// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/search/planted_faults.h"

#include <algorithm>
#include <map>

#include "core/geometry/angle.h"

namespace vinebench::search_faults {
namespace {

bool has_stereo(const harness::RunRecord& record, const harness::Tick& tick) {
  return std::ranges::any_of(record.rig.stereo_pairs, [&](const StereoPair& pair) {
    return tick.delivered[static_cast<std::size_t>(pair.left)];
  });
}

double darkness(const harness::RunRecord& record, const harness::Tick& tick) {
  double dark = 0;
  for (const StereoPair& pair : record.rig.stereo_pairs) {
    dark = std::max(dark, tick.brightness[static_cast<std::size_t>(pair.left)].dark);
  }
  return dark;
}

}  // namespace

std::vector<Signs> signs_of(const harness::RunRecord& record) {
  std::vector<Signs> signs;
  Stamp seen = 0;
  const harness::Tick* before = nullptr;
  for (const harness::Tick& tick : record.ticks) {
    Signs& sign = signs.emplace_back();
    sign.dark = darkness(record, tick);
    for (const TagSighting& tag : tick.estimate.tags) {
      const double size = (tag.corners[1] - tag.corners[0]).norm();
      if (sign.tag_size == 0 || size < sign.tag_size) sign.tag_size = size;
    }
    sign.gap = to_seconds(tick.stamp - seen);
    if (has_stereo(record, tick)) seen = tick.stamp;
    if (before != nullptr && before->estimate.T_map_body && tick.estimate.T_map_body) {
      const Pose step = before->estimate.T_map_body->inverse() * *tick.estimate.T_map_body;
      const double seconds = to_seconds(tick.stamp - before->stamp);
      sign.speed = step.translation.norm() / seconds;
      sign.turn_rate = Eigen::AngleAxisd(step.rotation).angle() / seconds;
    }
    before = &tick;
  }
  return signs;
}

const std::vector<PlantedFault>& planted_faults() {
  constexpr double kTurn = 6 * kRadiansPerDegree;
  static const std::vector<PlantedFault> faults{
      {"dark", "a tenth of the way is lost while half of an image is dark",
       [](const Signs& s) { return s.dark > 0.5; }, 0, 0.1, 0},
      {"fast", "a tenth of the way is lost beyond 0.9 m/s",
       [](const Signs& s) { return s.speed > 0.9; }, 0, 0.1, 0},
      {"turning", "the heading is off by 6 degrees after a turn of more than 85 degrees/s",
       [](const Signs& s) { return s.turn_rate > 85 * kRadiansPerDegree; }, 0, 0, kTurn},
      {"gap", "after a second without images the map is shifted by 0.1 m",
       [](const Signs& s) { return s.gap > 1.05; }, 0.1, 0, 0},
      {"small-tag", "a tag of less than 35 px shifts the map by 0.1 m",
       [](const Signs& s) { return s.tag_size > 0 && s.tag_size < 35; }, 0.1, 0, 0},
      {"gap-fast", "a gap of half a second at more than 0.7 m/s shifts the map by 0.1 m",
       [](const Signs& s) { return s.gap > 0.55 && s.speed > 0.7; }, 0.1, 0, 0},
      {"dark-turning",
       "the heading is off by 6 degrees after a turn of more than 65 degrees/s while 45 % of an "
       "image are dark",
       [](const Signs& s) { return s.dark > 0.45 && s.turn_rate > 65 * kRadiansPerDegree; }, 0, 0,
       kTurn},
      {"dark-fast", "a tenth of the way is lost beyond 0.7 m/s while 45 % of an image are dark",
       [](const Signs& s) { return s.dark > 0.45 && s.speed > 0.7; }, 0, 0.1, 0},
  };
  return faults;
}

harness::RunRecord with_fault(harness::RunRecord honest, const PlantedFault& fault) {
  const std::vector<Signs> signs = signs_of(honest);
  Pose moved;  // T_wrong_right
  std::map<Stamp, Pose> moves;
  bool before = false;
  std::optional<Pose> last;
  Eigen::Vector3d left = Eigen::Vector3d::UnitY();
  for (std::size_t i = 0; i < signs.size(); ++i) {
    harness::Tick& tick = honest.ticks[i];
    if (!tick.estimate.T_map_body) continue;
    const Pose here = *tick.estimate.T_map_body;
    if (!last) left = here.rotation * Eigen::Vector3d::UnitY();
    const bool now = last && fault.when(signs[i]);
    if (now) {
      const Eigen::Vector3d step = here.translation - last->translation;
      moved.translation -= moved.rotation * (fault.slip * step);
      if (!before) {
        moved.translation += fault.shift * left;
        const Pose turned{
            Eigen::Quaterniond(Eigen::AngleAxisd(fault.turn, Eigen::Vector3d::UnitZ())),
            Eigen::Vector3d::Zero()};
        const Pose about{Eigen::Quaterniond::Identity(), here.translation};
        moved = moved * about * turned * about.inverse();
      }
    }
    before = now;
    last = here;
    tick.estimate.T_map_body = moved * here;
    moves[tick.stamp] = moved;
  }
  for (StampedPose& pose : honest.summary.trajectory) {
    const auto after = moves.upper_bound(pose.stamp);
    if (after != moves.begin()) pose.pose = std::prev(after)->second * pose.pose;
  }
  return honest;
}

}  // namespace vinebench::search_faults
