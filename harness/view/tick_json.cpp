// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/tick_json.h"

#include "harness/page/page_numbers.h"
#include "harness/report/timeline.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillimetres = 1000;

Json pose_json(const std::optional<Pose>& pose) {
  if (!pose) return nullptr;
  Json values = Json::array();
  for (const double value : pose_values(*pose)) values.push_back(decimal(value));
  return values;
}

/// Of each camera; null where the system or the source does not tell.
template <class Value>
Json camera_values(std::size_t cameras, std::size_t known, const Value& value) {
  Json values = Json::array();
  for (std::size_t i = 0; i < cameras; ++i) values.push_back(i < known ? Json(value(i)) : Json());
  return values;
}

/// Of the map's axes, turned to the world's.
Json position_covariance(const Estimate& estimate, const Eigen::Matrix3d& R_world_body) {
  if (!estimate.T_map_body) return nullptr;
  return covariance_json(R_world_body, estimate.covariance.topLeftCorner<3, 3>());
}

Json loop_event(const Tick& tick) {
  const LoopClosure& loop = *tick.estimate.loop_closure;
  return TickEvents::event(tick, "loop_closure",
                           {{"tag", loop.tag_id},
                            {"earlier_t", exact_seconds(loop.earlier)},
                            {"later_t", exact_seconds(loop.later)},
                            {"correction_m", loop.correction},
                            {"correct", nullptr}});
}

}  // namespace

Json TickJson::of(const Tick& tick) {
  const Estimate& estimate = tick.estimate;
  const std::optional<Pose> truth =
      tick.truth.known ? std::optional(tick.truth.T_world_body) : std::nullopt;
  if (!T_world_map_ && estimate.T_map_body && truth) {
    T_world_map_ = *truth * estimate.T_map_body->inverse();
  }
  std::optional<Pose> live;
  if (estimate.T_map_body) live = T_world_map_.value_or(Pose()) * *estimate.T_map_body;
  Json json{{"t", decimal(to_seconds(tick.stamp))},
            {"frame", tick.index},
            {"truth", pose_json(truth)},
            {"live", pose_json(live)},
            {"error", truth && live
                          ? decimal(kMillimetres * (truth->translation - live->translation).norm())
                          : Json()},
            {"status", std::string(1, status_name(estimate.status)[0])},
            {"keyframe", estimate.keyframe},
            {"covariance",
             live ? position_covariance(estimate, live->rotation.toRotationMatrix()) : Json()},
            {"features", camera_values(cameras_, estimate.cameras.size(),
                                       [&](auto i) { return estimate.cameras[i].features; })},
            {"inliers", camera_values(cameras_, estimate.cameras.size(),
                                      [&](auto i) { return estimate.cameras[i].inliers; })},
            {"occluded", camera_values(cameras_, tick.truth.occlusion.size(), [&](auto i) {
               return brief(tick.truth.occlusion[i].total());
             })}};
  json["events"] = Json::array();
  for (Json& event : events_.of(tick)) json["events"].push_back(std::move(event));
  if (estimate.loop_closure) json["events"].push_back(loop_event(tick));
  return json;
}

}  // namespace vinebench::harness
