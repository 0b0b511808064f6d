// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/timeline.h"

#include <fmt/format.h>

#include "core/files/csv_field.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// Unknown values, as NumPy and pandas read them.
constexpr const char* kUnknown = ",nan";

std::string header_of(const Rig& rig) {
  std::string line = "t,frame,status,keyframe,xx,xy,xz,yy,yz,zz";
  for (const char* what : {"features", "inliers", "occluded"}) {
    for (const RigCamera& camera : rig.cameras) {
      line += ',';
      line += csv_field(fmt::format("{}:{}", what, camera.name));
    }
  }
  return line + "\n";
}

/// In the map's axes.
std::string covariance_of(const Estimate& estimate) {
  if (!estimate.T_map_body) return "nan,nan,nan,nan,nan,nan";
  const Eigen::Matrix3d R = estimate.T_map_body->rotation.toRotationMatrix();
  const Eigen::Matrix3d c = R * estimate.covariance.topLeftCorner<3, 3>() * R.transpose();
  return fmt::format("{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}", c(0, 0), c(0, 1), c(0, 2),
                     c(1, 1), c(1, 2), c(2, 2));
}

std::string cameras_of(const Tick& tick, std::size_t cameras) {
  std::string text;
  const auto counts = [&](int CameraCounts::*count) {
    for (std::size_t i = 0; i < cameras; ++i) {
      text += i < tick.estimate.cameras.size() ? fmt::format(",{}", tick.estimate.cameras[i].*count)
                                               : kUnknown;
    }
  };
  counts(&CameraCounts::features);
  counts(&CameraCounts::inliers);
  for (std::size_t i = 0; i < cameras; ++i) {
    text += i < tick.truth.occlusion.size()
                ? fmt::format(",{:.4g}", tick.truth.occlusion[i].total())
                : kUnknown;
  }
  return text;
}

Json json_of(const Eigen::Vector2d& v) {
  return {v.x(), v.y()};
}
Json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Json json_of(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {
      pose.translation.x(), pose.translation.y(), pose.translation.z(), q.x(), q.y(), q.z(), q.w()};
}

Json cameras_json(const Rig& rig) {
  Json cameras = Json::array();
  for (const RigCamera& camera : rig.cameras) {
    cameras.push_back({{"name", camera.name},
                       {"width", camera.model.width},
                       {"height", camera.model.height},
                       {"fx", camera.model.fx},
                       {"fy", camera.model.fy},
                       {"T_body_cam", json_of(camera.T_body_cam)}});
  }
  return cameras;
}

Json objects_json(const Site& site) {
  Json objects = Json::array();
  for (const Site::Object& object : site.objects) {
    objects.push_back({{"class", name_of(object.kind)},
                       {"centre", json_of(object.centre)},
                       {"size", {object.size.x(), object.size.y(), object.height}},
                       {"foot", object.foot},
                       {"yaw_deg", object.yaw_deg},
                       {"colour", json_of(object.colour)},
                       {"moves", object.moves}});
  }
  return objects;
}

Json tags_json(const Site& site) {
  Json tags = Json::array();
  for (const WorldTag& tag : site.tags) {
    tags.push_back({{"family", tag.family},
                    {"id", tag.id},
                    {"size", tag.size},
                    {"T_world_tag", json_of(tag.T_world_tag)},
                    {"registered", tag.registered}});
  }
  return tags;
}

}  // namespace

const char* status_name(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kInitializing:
      return "initialising";
    case TrackingStatus::kTracking:
      return "tracked";
    case TrackingStatus::kDeadReckoning:
      return "dead_reckoning";
    case TrackingStatus::kLost:
      return "lost";
  }
  return "";
}

std::string format_timeline(const RunRecord& record) {
  std::string text = header_of(record.rig);
  for (const Tick& tick : record.ticks) {
    text += fmt::format("{},{},{},{:d},", format_seconds(tick.stamp), tick.index,
                        status_name(tick.estimate.status), tick.estimate.keyframe);
    text += covariance_of(tick.estimate) + cameras_of(tick, record.rig.cameras.size()) + "\n";
  }
  return text;
}

Json site_json(const Site& site, const Rig& rig) {
  Json rows = Json::array(), vines = Json::array(), posts = Json::array();
  for (const Site::Row& row : site.rows) {
    rows.push_back({row.start.x(), row.start.y(), row.end.x(), row.end.y()});
  }
  for (const Eigen::Vector2d& foot : site.vines) vines.push_back(json_of(foot));
  for (const Eigen::Vector2d& foot : site.posts) posts.push_back(json_of(foot));
  return {{"name", site.name},
          {"rows", rows},
          {"vines", vines},
          {"posts", posts},
          {"objects", objects_json(site)},
          {"tags", tags_json(site)},
          {"canopy", {site.canopy_depth, site.canopy_foot, site.canopy_top}},
          {"post", {site.post_radius, site.post_height}},
          {"rate_hz", rig.rate_hz},
          {"cameras", cameras_json(rig)}};
}

}  // namespace vinebench::harness
