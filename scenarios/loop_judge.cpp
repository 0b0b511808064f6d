// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/loop_judge.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace vinebench {
namespace {

const Tick* find_tick(const RunRecord& record, Stamp stamp) {
  const auto found = std::ranges::lower_bound(record.ticks, stamp, {}, &Tick::stamp);
  return found != record.ticks.end() && found->stamp == stamp ? &*found : nullptr;
}

JudgedClosure judge(const RunRecord& record, std::size_t tick) {
  JudgedClosure judged{.tick = tick, .closure = *record.ticks[tick].estimate.loop_closure};
  const Tick* earlier = find_tick(record, judged.closure.earlier);
  const Tick* later = find_tick(record, judged.closure.later);
  if (earlier == nullptr || later == nullptr) {  // ties frames that never were
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

/// Tags by index into RunRecord::tags that stand for each other.
using Reference = std::vector<int>;

/// All registered tags, any of which tells where in the world the rover is; each other by itself.
std::vector<Reference> references(const RunRecord& record) {
  std::vector<Reference> references(1);
  for (std::size_t t = 0; t < record.tags.size(); ++t) {
    const int tag = static_cast<int>(t);
    if (record.tags[t].registered) {
      references.front().push_back(tag);
    } else {
      references.push_back({tag});
    }
  }
  return references;
}

std::vector<TagVisit> visits_of(const RunRecord& record, const Reference& reference,
                                const std::vector<double>& lengths) {
  std::vector<TagVisit> visits;
  Stamp run_begin = 0;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    const std::vector<int>& visible = record.ticks[i].truth.visible_tags;
    const auto seen = std::ranges::find_first_of(visible, reference);
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

/// Whether a closure with one of the tags was reported since the visit before: a detector may read
/// a tag from afar, before the truth calls it readable, and then closes the loop early.
bool was_closed(const RunRecord& record, const LoopVerdict& verdict, const Reference& reference,
                const TagVisit& before, const TagVisit& visit) {
  return std::ranges::any_of(verdict.closures, [&](const JudgedClosure& judged) {
    const bool same = std::ranges::any_of(reference, [&](int tag) {
      return record.tags[static_cast<std::size_t>(tag)].id == judged.closure.tag_id;
    });
    return same && judged.closure.later > record.ticks[before.last].stamp &&
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
  for (const Reference& reference : references(record)) {
    const std::vector<TagVisit> more = visits_of(record, reference, lengths);
    visits.insert(visits.end(), more.begin(), more.end());
  }
  return visits;
}

LoopVerdict judge_loop_closures(const RunRecord& record) {
  LoopVerdict verdict;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    if (record.ticks[i].estimate.loop_closure) verdict.closures.push_back(judge(record, i));
  }
  const std::vector<double> lengths = true_path_lengths(record);
  for (const Reference& reference : references(record)) {
    const std::vector<TagVisit> visits = visits_of(record, reference, lengths);
    for (std::size_t i = 1; i < visits.size(); ++i) {
      if (visits[i].longest < kVisitSeconds) continue;
      if (was_closed(record, verdict, reference, visits[i - 1], visits[i])) continue;
      verdict.missed.push_back(visits[i]);
    }
  }
  return verdict;
}

}  // namespace vinebench
