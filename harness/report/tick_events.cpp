// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/tick_events.h"

#include <numbers>

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

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

double exact_seconds(Stamp stamp) {
  return static_cast<double>(stamp) / 1e9;
}

Json TickEvents::event(const Tick& tick, const char* name, const Json& more) {
  Json event{{"t", exact_seconds(tick.stamp)}, {"frame", tick.index}, {"event", name}};
  event.update(more);
  return event;
}

std::vector<Json> TickEvents::of(const Tick& tick) {
  tick_ = &tick;
  ++at_;
  events_.clear();
  measure_path();
  add_source_events();
  add_losses();
  for (std::size_t camera = 0; camera < rig_.cameras.size(); ++camera) add_occlusion(camera);
  add_sightings();
  add_rejections();
  add_calibration();
  add_world();
  if (tick.estimate.keyframe) add("keyframe");
  return events_;
}

void TickEvents::add(const char* name, const Json& more) {
  events_.push_back(event(*tick_, name, more));
}

void TickEvents::measure_path() {
  if (!tick_->truth.known) return;
  const Eigen::Vector3d& place = tick_->truth.T_world_body.translation;
  if (last_place_) length_ += (place - *last_place_).norm();
  last_place_ = place;
}

void TickEvents::add_source_events() {
  for (const SourceEvent& event : tick_->events) {
    add(event.event.c_str(), {{"sensor", event.sensor}, {"detail", event.detail}});
  }
}

void TickEvents::add_losses() {
  const bool tracked = is_tracked(tick_->estimate);
  const bool reckons = tick_->estimate.status == TrackingStatus::kDeadReckoning;
  if (had_pose_ && !tracked) add("lost", {{"dead_reckoning", reckons}});
  if (reckoned_ && !tracked && !reckons) add("dead_reckoning_given_up");
  reckoned_ = reckons;
  if (!had_pose_ && tracked) add(ever_had_pose_ ? "relocalised" : "initialised");
  had_pose_ = tracked;
  ever_had_pose_ = ever_had_pose_ || tracked;
}

void TickEvents::add_occlusion(std::size_t camera) {
  if (camera >= tick_->truth.occlusion.size()) return;
  const Occlusion& seen = tick_->truth.occlusion[camera];
  const bool occluded = seen.total() >= box_share_;
  const auto open = occlusions_.find(camera);
  const std::string& name = rig_.cameras[camera].name;
  if (occluded && open == occlusions_.end()) {
    occlusions_[camera] = {tick_->stamp, length_};
    add("occlusion_begin", {{"camera", name},
                            {"occluder", name_of(seen.largest())},
                            {"share", seen.total()},
                            {"box_share", seen.share(OccluderClass::kCarton)}});
  } else if (!occluded && open != occlusions_.end()) {
    add("occlusion_end", {{"camera", name},
                          {"seconds", exact_seconds(tick_->stamp - open->second.stamp)},
                          {"metres", length_ - open->second.length}});
    occlusions_.erase(open);
  }
}

/// One event when a tag comes into a camera's view and one when it has left it.
void TickEvents::add_sightings() {
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
void TickEvents::add_rejections() {
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

void TickEvents::add_calibration() {
  const RigCalibration& calibration = tick_->estimate.calibration;
  if (calibration.empty()) return;
  Json found = Json::array();
  for (const PairCalibration& pair : calibration.pairs) {
    const Eigen::Vector3d& p = pair.T_nominal_camera.translation;
    const Eigen::Vector3d turn = log_so3(pair.T_nominal_camera.rotation) * 180 / std::numbers::pi;
    const Eigen::Vector3d eye = pair.right_turn * 180 / std::numbers::pi;
    found.push_back({{"position_m", {p.x(), p.y(), p.z()}},
                     {"rotation_deg", {turn.x(), turn.y(), turn.z()}},
                     {"disparity_offset_px", pair.disparity_offset},
                     {"disparity_slope", pair.disparity_slope},
                     {"focal", pair.focal},
                     {"baseline", pair.baseline},
                     {"time_s", pair.time},
                     {"readout_s", pair.readout},
                     {"principal_point_px", {pair.principal_point.x(), pair.principal_point.y()}},
                     {"right_turn_deg", {eye.x(), eye.y(), eye.z()}},
                     {"right_ahead", pair.right_ahead}});
  }
  add("calibrated", {{"pairs", found}, {"tag_times_s", calibration.tag_times}});
}

/// One event at the first pose in the world.
void TickEvents::add_world() {
  const auto& T_world_map = tick_->estimate.T_world_map;
  if (!T_world_map || in_world_) return;
  in_world_ = true;
  const Eigen::Vector3d& p = T_world_map->translation;
  const Eigen::Quaterniond& q = T_world_map->rotation;
  add("placed",
      {{"position_m", {p.x(), p.y(), p.z()}}, {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}});
}

Json TickEvents::describe(const TagKey& tag, std::optional<double> distance) const {
  Json more{{"camera", rig_.cameras.at(static_cast<std::size_t>(tag.camera)).name},
            {"family", tag.family},
            {"id", tag.id}};
  if (distance) more["distance_m"] = *distance;
  return more;
}

}  // namespace vinebench::harness
