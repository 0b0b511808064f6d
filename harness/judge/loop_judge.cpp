// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/loop_judge.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace vinebench::harness {
namespace {

const Tick* find_tick(const RunRecord& record, Stamp stamp) {
  const auto found = std::ranges::lower_bound(record.ticks, stamp, {}, &Tick::stamp);
  return found != record.ticks.end() && found->stamp == stamp ? &*found : nullptr;
}

JudgedClosure judge(const RunRecord& record, std::size_t tick) {
  JudgedClosure judged{.tick = tick, .closure = *record.ticks[tick].estimate.loop_closure};
  const Tick* earlier = find_tick(record, judged.closure.earlier);
  const Tick* later = find_tick(record, judged.closure.later);
  if (earlier == nullptr || later == nullptr) {  // constrains frames that do not exist
    judged.error_m = judged.error_rad = std::numeric_limits<double>::infinity();
    return judged;
  }
  judged.judged = earlier->truth.known && later->truth.known;
  if (!judged.judged) return judged;
  const Pose truth = earlier->truth.T_world_body.inverse() * later->truth.T_world_body;
  const Pose error = truth.inverse() * judged.closure.T_earlier_later;
  judged.error_m = error.translation.norm();
  judged.error_rad = angle_of(error.rotation);
  judged.correct = judged.error_m <= kLoopClosureMetres &&
                   judged.error_rad <= kLoopClosureDegrees * std::numbers::pi / 180;
  return judged;
}

/// Whether tags (indices into RunRecord::tags) are equivalent: any registered tag gives the rover's
/// pose in the world, an unregistered one only the pose relative to itself.
bool alike(const RunRecord& record, int a, int b) {
  const auto registered = [&](int tag) {
    return record.tags[static_cast<std::size_t>(tag)].registered;
  };
  return a == b || (registered(a) && registered(b));
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

/// Whether a closure with one of the tags was reported since the previous visit: a detector may
/// find a distant tag before the truth counts it as visible, and then closes the loop early.
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
    return is_of_visit(judged.closure) && judged.closure.later > record.ticks[before.last].stamp &&
           judged.closure.later <= record.ticks[visit.last].stamp;
  });
}

}  // namespace

int LoopVerdict::correct() const {
  return static_cast<int>(std::ranges::count(closures, true, &JudgedClosure::correct));
}

int LoopVerdict::wrong() const {
  return static_cast<int>(std::ranges::count_if(
      closures, [](const JudgedClosure& closure) { return closure.judged && !closure.correct; }));
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
    if (again && !was_closed(record, verdict, visits[i - 1], visits[i])) {
      verdict.missed.push_back(visits[i]);
    }
  }
  return verdict;
}

}  // namespace vinebench::harness
