// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/events.h"

#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "harness/datasets/files/json_file.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// Division, not multiplication: gives the double nearest to the decimal number.
double exact_seconds(Stamp stamp) {
  return static_cast<double>(stamp) / 1e9;
}

const char* name_of(TagRejection reason) {
  switch (reason) {
    case TagRejection::kAmbiguous:
      return "ambiguous";
    case TagRejection::kMisplaced:
      return "misplaced";
    case TagRejection::kDuplicate:
      return "duplicate";
  }
  return "";
}

/// Converts ticks to events and keeps the state of intervals that have not ended.
class EventLog {
 public:
  EventLog(const RunRecord& record, const RunResults& results,
           const std::vector<DegradedSegment>& segments, double box_share)
      : record_(record),
        results_(results),
        explanations_(segments),
        lengths_(true_path_lengths(record)) {
    for (std::size_t i = 0; i < record.ticks.size(); ++i) {
      tick_ = &record.ticks[i];
      at_ = i;
      add_source_events();
      add_losses();
      for (std::size_t camera = 0; camera < record.rig.cameras.size(); ++camera) {
        add_occlusion(camera, box_share);
      }
      add_sightings();
      add_rejections();
      add_calibration();
      if (tick_->estimate.keyframe) add("keyframe");
      add_loop_closures();
      add_explanations();
    }
  }
  std::string take() { return std::move(text_); }

 private:
  void add(const char* event, const Json& more = Json::object()) {
    Json line{{"t", exact_seconds(tick_->stamp)}, {"frame", tick_->index}, {"event", event}};
    line.update(more);
    text_ += json_text(line) + "\n";
  }

  void add_source_events() {
    for (const SourceEvent& event : tick_->events) {
      add(event.event.c_str(), {{"sensor", event.sensor}, {"detail", event.detail}});
    }
  }

  void add_losses() {
    const bool tracked = is_tracked(tick_->estimate);
    const bool reckons = tick_->estimate.status == TrackingStatus::kDeadReckoning;
    if (had_pose_ && !tracked) add("lost", {{"dead_reckoning", reckons}});
    if (reckoned_ && !tracked && !reckons) add("dead_reckoning_given_up");
    reckoned_ = reckons;
    if (!had_pose_ && tracked) add(ever_had_pose_ ? "relocalised" : "initialised");
    had_pose_ = tracked;
    ever_had_pose_ = ever_had_pose_ || tracked;
  }

  void add_occlusion(std::size_t camera, double box_share) {
    if (camera >= tick_->truth.occlusion.size()) return;
    const Occlusion& seen = tick_->truth.occlusion[camera];
    const bool occluded = seen.total() >= box_share;
    const auto open = occlusions_.find(camera);
    const std::string& name = record_.rig.cameras[camera].name;
    if (occluded && open == occlusions_.end()) {
      occlusions_[camera] = at_;
      add("occlusion_begin", {{"camera", name},
                              {"occluder", name_of(seen.largest())},
                              {"share", seen.total()},
                              {"box_share", seen.share(OccluderClass::kCarton)}});
    } else if (!occluded && open != occlusions_.end()) {
      const Stamp begin = record_.ticks[open->second].stamp;
      add("occlusion_end", {{"camera", name},
                            {"seconds", exact_seconds(tick_->stamp - begin)},
                            {"metres", lengths_[at_] - lengths_[open->second]}});
      occlusions_.erase(open);
    }
  }

  /// One event when a tag comes into a camera's view and one when it has left it.
  void add_sightings() {
    for (const TagSighting& tag : tick_->estimate.tags) {
      const auto [open, is_new] = sightings_.try_emplace({tag.camera, tag.family, tag.id});
      if (is_new) add("tag_seen", describe(open->first, tag.T_cam_tag.translation.norm()));
      open->second.last = at_;
      ++open->second.frames;
    }
    for (auto open = sightings_.begin(); open != sightings_.end();) {
      if (open->second.last == at_) {
        ++open;
        continue;
      }
      Json more = describe(open->first, std::nullopt);
      more["frames"] = open->second.frames;
      add("tag_gone", more);
      open = sightings_.erase(open);
    }
  }

  /// One event when a tag is rejected and was not rejected for this reason in the previous frame.
  void add_rejections() {
    std::set<Rejection> now;
    for (const RejectedTag& tag : tick_->estimate.rejected_tags) {
      const Rejection rejection{{tag.camera, tag.family, tag.id}, tag.reason};
      if (!now.insert(rejection).second || rejected_.contains(rejection)) continue;
      Json more = describe(rejection.first, std::nullopt);
      more["reason"] = name_of(tag.reason);
      add("tag_rejected", more);
    }
    rejected_ = std::move(now);
  }

  void add_calibration() {
    const std::vector<double>& offsets = tick_->estimate.disparity_offsets;
    if (!offsets.empty()) add("calibrated", {{"disparity_offsets_px", offsets}});
  }

  struct TagKey {
    int camera;
    std::string family;
    int id;
    auto operator<=>(const TagKey&) const = default;
  };
  using Rejection = std::pair<TagKey, TagRejection>;
  struct Sighting {
    std::size_t last = 0;
    int frames = 0;
  };

  Json describe(const TagKey& tag, std::optional<double> distance) const {
    Json more{{"camera", record_.rig.cameras.at(static_cast<std::size_t>(tag.camera)).name},
              {"family", tag.family},
              {"id", tag.id}};
    if (distance) more["distance_m"] = *distance;
    return more;
  }

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
  std::vector<double> lengths_;
  const Tick* tick_ = nullptr;
  std::size_t at_ = 0;
  bool had_pose_ = false;
  bool ever_had_pose_ = false;
  bool reckoned_ = false;
  std::map<std::size_t, std::size_t> occlusions_;  ///< camera to the first tick
  std::map<TagKey, Sighting> sightings_;
  std::set<Rejection> rejected_;  ///< in the previous frame
  std::string text_;
};

}  // namespace

std::string format_events(const RunRecord& record, const RunResults& results,
                          const std::vector<DegradedSegment>& segments, double box_share) {
  return EventLog(record, results, segments, box_share).take();
}

}  // namespace vinebench::harness
