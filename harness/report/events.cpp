// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/events.h"

#include <numbers>
#include <utility>

#include "harness/datasets/files/json_file.h"
#include "harness/report/report_json.h"
#include "harness/report/tick_events.h"

namespace vinebench::harness {
namespace {

/// What is known of the ticks after the run, behind what each says by itself.
class EventLog {
 public:
  EventLog(const RunRecord& record, const RunResults& results,
           const std::vector<DegradedSegment>& segments, double box_share)
      : record_(record), results_(results), explanations_(segments) {
    TickEvents events(record.rig, box_share);
    for (std::size_t i = 0; i < record.ticks.size(); ++i) {
      tick_ = &record.ticks[i];
      at_ = i;
      for (const Json& event : events.of(*tick_)) append(event);
      add_loop_closures();
      add_explanations();
    }
  }
  std::string take() { return std::move(text_); }

 private:
  void append(const Json& event) { text_ += json_text(event) + "\n"; }
  void add(const char* event, const Json& more) { append(TickEvents::event(*tick_, event, more)); }

  template <class T>
  static Json if_judged(const JudgedClosure& closure, T value) {
    return closure.judged ? Json(value) : Json();
  }

  void add_loop_closures() {
    for (const JudgedClosure& judged : results_.loops.closures) {
      if (judged.tick != at_) continue;
      add("loop_closure",
          {{"tag", judged.closure.tag_id},
           {"earlier_t", exact_seconds(judged.closure.earlier)},
           {"later_t", exact_seconds(judged.closure.later)},
           {"correction_m", judged.closure.correction},
           {"error_m", if_judged(judged, judged.error_m)},
           {"error_deg", if_judged(judged, judged.error_rad * 180 / std::numbers::pi)},
           {"correct", if_judged(judged, judged.correct)}});
    }
    for (const TagVisit& visit : results_.loops.missed) {
      if (visit.last != at_) continue;
      add("loop_closure_missed",
          {{"tag", record_.tags[static_cast<std::size_t>(visit.tag)].id},
           {"seen_since_t", exact_seconds(record_.ticks[visit.first].stamp)}});
    }
  }

  /// When the segment has ended.
  void add_explanations() {
    for (const DegradedSegment& explanation : explanations_) {
      if (explanation.last != at_) continue;
      Json more{{"from", exact_seconds(record_.ticks[explanation.first].stamp)},
                {"until", exact_seconds(tick_->stamp)},
                {"cause", name_of(explanation.cause)},
                {"cameras", Json::array()},
                {"share", explanation.share},
                {"error_growth_m", explanation.error_growth},
                {"untracked_frames", explanation.untracked},
                {"inliers", explanation.inliers},
                {"inliers_usual", explanation.usual_inliers}};
      if (explanation.occluder) more["occluder"] = name_of(*explanation.occluder);
      for (const std::size_t camera : explanation.cameras) {
        more["cameras"].push_back(record_.rig.cameras[camera].name);
      }
      add("explained", more);
    }
  }

  const RunRecord& record_;
  const RunResults& results_;
  const std::vector<DegradedSegment>& explanations_;
  const Tick* tick_ = nullptr;
  std::size_t at_ = 0;
  std::string text_;
};

}  // namespace

std::string format_events(const RunRecord& record, const RunResults& results,
                          const std::vector<DegradedSegment>& segments, double box_share) {
  return EventLog(record, results, segments, box_share).take();
}

}  // namespace vinebench::harness
