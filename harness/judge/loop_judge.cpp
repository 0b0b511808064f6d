// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/loop_judge.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <utility>

#include "core/geometry/angle.h"

namespace vinebench::harness {
namespace {

/// How far outside of the image a corner may be by an error of the nominal rig, px.
constexpr double kCornerMargin = 5;

const Tick* find_tick(const RunRecord& record, Stamp stamp) {
  const auto found = std::ranges::lower_bound(record.ticks, stamp, {}, &Tick::stamp);
  return found != record.ticks.end() && found->stamp == stamp ? &*found : nullptr;
}

/// Whether tags (indices into RunRecord::tags) are equivalent: any registered tag gives the rover's
/// pose in the world, an unregistered one only the pose relative to itself.
bool alike(const RunRecord& record, int a, int b) {
  const auto registered = [&](int tag) {
    return record.tags[static_cast<std::size_t>(tag)].registered;
  };
  return a == b || (registered(a) && registered(b));
}

/// Whether a registered tag has that number.
bool names_registered(const RunRecord& record, int id) {
  return std::ranges::any_of(record.tags,
                             [&](const WorldTag& tag) { return tag.registered && tag.id == id; });
}

/// Squared distance in standard deviations; nothing without a covariance.
std::optional<double> chi_squared_of(const Pose& error, const LoopClosure& closure) {
  if (!closure.covariance) return std::nullopt;
  const double turn = kClosureFloorDegrees * kRadiansPerDegree;
  Vector6d floor;
  floor << Eigen::Vector3d::Constant(kClosureFloorMetres), Eigen::Vector3d::Constant(turn);
  Matrix6d covariance = *closure.covariance;
  covariance.diagonal() += floor.cwiseAbs2();
  Vector6d step;
  step << error.translation, log_so3(error.rotation);
  return step.dot(covariance.ldlt().solve(step));
}

/// Whether a tag's corners are ahead of a tag camera of the nominal rig and in its image, with the
/// printed face towards it. What stands between is not considered.
bool can_be_seen(const WorldTag& tag, const Rig& rig, const Pose& T_world_body) {
  const double h = tag.size / 2;
  return std::ranges::any_of(rig.tag_cameras, [&](int index) {
    const RigCamera& camera = rig.cameras[static_cast<std::size_t>(index)];
    const Pose T_cam_tag = (T_world_body * camera.T_body_cam).inverse() * tag.T_world_tag;
    if (T_cam_tag.translation.dot(T_cam_tag.rotation * Eigen::Vector3d::UnitZ()) <= 0) return false;
    for (const auto& [x, y] : {std::pair(-h, h), {h, h}, {h, -h}, {-h, -h}}) {
      const Eigen::Vector3d corner = T_cam_tag * Eigen::Vector3d(x, y, 0);
      if (corner.z() <= 0 || !camera.model.contains(camera.model.project(corner), -kCornerMargin)) {
        return false;
      }
    }
    return true;
  });
}

/// Whether a tag of that closure is in view: at its later end the one that it names, at the earlier
/// one that or an equivalent one.
bool sees_tag(const RunRecord& record, const Tick& tick, int id, bool equivalents) {
  for (int tag = 0; tag < static_cast<int>(record.tags.size()); ++tag) {
    const WorldTag& candidate = record.tags[static_cast<std::size_t>(tag)];
    const bool meant =
        candidate.id == id || (equivalents && candidate.registered && names_registered(record, id));
    if (!meant) continue;
    if (std::ranges::count(tick.truth.visible_tags, tag) > 0 ||
        can_be_seen(candidate, record.rig, tick.truth.T_world_body)) {
      return true;
    }
  }
  return false;
}

/// A closure by appearance names no tag, and a source without tags or tag cameras shows none.
bool is_by_visible_tag(const RunRecord& record, const Tick& earlier, const Tick& later, int id) {
  if (id < 0 || record.tags.empty() || record.rig.tag_cameras.empty()) return true;
  return sees_tag(record, earlier, id, true) && sees_tag(record, later, id, false);
}

bool agrees(const JudgedClosure& judged) {
  return judged.error_m <= kLoopClosureMetres &&
         judged.error_rad <= kLoopClosureDegrees * kRadiansPerDegree &&
         judged.chi_squared.value_or(0) <= kClosureChiSquared;
}

JudgedClosure judge(const RunRecord& record, std::size_t tick) {
  JudgedClosure judged{.tick = tick, .closure = *record.ticks[tick].estimate.loop_closure};
  const LoopClosure& closure = judged.closure;
  const Tick* earlier = find_tick(record, closure.earlier);
  const Tick* later = find_tick(record, closure.later);
  if (earlier == nullptr || later == nullptr) {  // constrains frames that do not exist
    judged.error_m = judged.error_rad = std::numeric_limits<double>::infinity();
    return judged;
  }
  judged.judged = earlier->truth.known && later->truth.known;
  if (!judged.judged) return judged;
  const Pose truth = earlier->truth.T_world_body.inverse() * later->truth.T_world_body;
  const Pose error = truth.inverse() * closure.T_earlier_later;
  judged.error_m = error.translation.norm();
  judged.error_rad = angle_of(error.rotation);
  judged.chi_squared = chi_squared_of(error, closure);
  const bool right = agrees(judged) && is_by_visible_tag(record, *earlier, *later, closure.tag_id);
  const bool apart = closure.later - closure.earlier >= kVisitGap;
  judged.correct = right && apart;
  judged.trivial = right && !apart;
  return judged;
}

/// Of that tag and equivalent ones.
std::vector<TagVisit> visits_of(const RunRecord& record, int tag,
                                const std::vector<double>& lengths) {
  std::vector<TagVisit> visits;
  Stamp run_begin = 0;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    const std::vector<int>& visible = record.ticks[i].truth.visible_tags;
    const auto seen =
        std::ranges::find_if(visible, [&](int other) { return alike(record, tag, other); });
    if (seen == visible.end()) continue;
    const Stamp now = record.ticks[i].stamp;
    const bool again =
        visits.empty() || (now - record.ticks[visits.back().last].stamp >= kVisitGap &&
                           lengths[i] - lengths[visits.back().last] >= kVisitGapMetres);
    if (again) visits.push_back({.tag = *seen, .first = i, .last = i});
    if (again || i - visits.back().last > 1) run_begin = now;
    visits.back().last = i;
    visits.back().longest = std::max(visits.back().longest, now - run_begin);
  }
  return visits;
}

/// Whether a closure with one of the tags, and not a wrong one, was reported since the previous
/// visit: a detector may find a distant tag before the truth counts it as visible, and then closes
/// the loop early.
bool was_closed(const RunRecord& record, const LoopVerdict& verdict, const TagVisit& before,
                const TagVisit& visit) {
  const auto is_of_visit = [&](const LoopClosure& closure) {
    for (int tag = 0; tag < static_cast<int>(record.tags.size()); ++tag) {
      const bool named = record.tags[static_cast<std::size_t>(tag)].id == closure.tag_id;
      if (named && alike(record, tag, visit.tag)) return true;
    }
    return false;
  };
  return std::ranges::any_of(verdict.closures, [&](const JudgedClosure& judged) {
    const bool valid = judged.correct || !judged.judged;
    return valid && is_of_visit(judged.closure) &&
           judged.closure.later > record.ticks[before.last].stamp &&
           judged.closure.later <= record.ticks[visit.last].stamp;
  });
}

}  // namespace

int LoopVerdict::correct() const {
  return static_cast<int>(std::ranges::count(closures, true, &JudgedClosure::correct));
}

int LoopVerdict::wrong() const {
  return static_cast<int>(std::ranges::count_if(closures, &JudgedClosure::wrong));
}

std::vector<TagVisit> tag_visits(const RunRecord& record) {
  const std::vector<double> lengths = true_path_lengths(record);
  std::vector<TagVisit> visits;
  bool registered_done = false;
  for (std::size_t tag = 0; tag < record.tags.size(); ++tag) {
    if (record.tags[tag].registered && std::exchange(registered_done, true)) continue;
    const std::vector<TagVisit> more = visits_of(record, static_cast<int>(tag), lengths);
    visits.insert(visits.end(), more.begin(), more.end());
  }
  return visits;
}

LoopVerdict judge_loop_closures(const RunRecord& record) {
  LoopVerdict verdict;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    if (record.ticks[i].estimate.loop_closure) verdict.closures.push_back(judge(record, i));
  }
  const std::vector<TagVisit> visits = tag_visits(record);
  for (std::size_t i = 1; i < visits.size(); ++i) {
    const bool again =
        alike(record, visits[i].tag, visits[i - 1].tag) && visits[i].longest >= kVisitSeconds;
    if (!again) continue;
    ++verdict.returns;
    if (!was_closed(record, verdict, visits[i - 1], visits[i])) {
      verdict.missed.push_back(visits[i]);
    }
  }
  return verdict;
}

}  // namespace vinebench::harness
