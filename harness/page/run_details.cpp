// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/run_details.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "core/files/files.h"
#include "core/files/json_depth.h"
#include "core/trajectory.h"
#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/files/text_table.h"
#include "harness/judge/evaluation.h"
#include "harness/page/landmark_cloud.h"
#include "harness/page/page_numbers.h"
#include "harness/report/run_folder.h"
#include "harness/report/timeline.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kMillimetres = 1000;

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

std::string text_if_there(const fs::path& file) {
  return is_there(file) ? read_file(file, FileKind::kTable) : "";
}

std::map<Stamp, Pose> by_stamp(const Trajectory& trajectory) {
  std::map<Stamp, Pose> poses;
  for (const auto& [stamp, pose] : trajectory) poses[stamp] = pose;
  return poses;
}

/// A run's frames, each a stamp.
struct Paths {
  std::vector<Stamp> stamps;
  std::map<Stamp, Pose> truth, corrected, live;  ///< in the world
  Pose T_world_map;
};

Trajectory poses_of(const fs::path& file) {
  return is_there(file) ? read_tum(file) : Trajectory();
}

Paths read_paths(const fs::path& folder, const std::vector<TableRow>& timeline) {
  Paths paths;
  const Trajectory truth = poses_of(folder / "groundtruth.tum");
  const Trajectory corrected = poses_of(folder / "estimate.tum");
  const Trajectory live = poses_of(folder / "estimate_live.tum");
  for (const TableRow& row : timeline) paths.stamps.push_back(row.seconds(0));
  if (timeline.empty()) {
    for (const StampedPose& at : truth.empty() ? corrected : truth) {
      paths.stamps.push_back(at.stamp);
    }
  }
  const auto pairs = associate(truth, corrected);
  const auto live_pairs = associate(truth, live);
  if (!pairs.empty()) paths.T_world_map = align_first(pairs);
  const Pose live_alignment = live_pairs.empty() ? paths.T_world_map : align_first(live_pairs);
  paths.truth = by_stamp(truth);
  for (const auto& [stamp, pose] : corrected) paths.corrected[stamp] = paths.T_world_map * pose;
  for (const auto& [stamp, pose] : live) paths.live[stamp] = live_alignment * pose;
  return paths;
}

/// Columns x, y, z, qx, qy, qz, qw; null where there is no pose.
Json path_json(const std::vector<Stamp>& stamps, const std::map<Stamp, Pose>& poses) {
  if (poses.empty()) return nullptr;
  std::array<Json, 7> columns;
  columns.fill(Json::array());
  for (const Stamp stamp : stamps) {
    const auto found = poses.find(stamp);
    const auto values = pose_values(found == poses.end() ? Pose() : found->second);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      columns.at(i).push_back(found == poses.end() ? Json() : decimal(values.at(i)));
    }
  }
  return columns;
}

/// mm; null where a pose is missing.
Json error_json(const std::vector<Stamp>& stamps, const std::map<Stamp, Pose>& truth,
                const std::map<Stamp, Pose>& estimate) {
  if (truth.empty() || estimate.empty()) return nullptr;
  Json errors = Json::array();
  for (const Stamp stamp : stamps) {
    const auto a = truth.find(stamp), b = estimate.find(stamp);
    errors.push_back(
        a == truth.end() || b == estimate.end()
            ? Json()
            : decimal(kMillimetres * (a->second.translation - b->second.translation).norm()));
  }
  return errors;
}

/// The same frames of every series.
template <class Row>
std::vector<Row> every_nth(const std::vector<Row>& rows, std::size_t step) {
  std::vector<Row> some;
  for (std::size_t i = 0; i < rows.size(); i += step) some.push_back(rows[i]);
  return some;
}

double value_of(const TableRow& row, std::size_t column) {
  return row.fields[column] == "nan" ? std::nan("") : row.number(column);
}

constexpr std::size_t kCovariance = 4;  // first column
constexpr std::size_t kCameras = 10;    // first column of what cameras saw

void expect_columns(const std::vector<TableRow>& rows, std::size_t cameras) {
  for (const TableRow& row : rows) {
    if (row.fields.size() != kCameras + 3 * cameras) {
      row.fault(fmt::format("expected {} columns, of {} cameras, found {}", kCameras + 3 * cameras,
                            cameras, row.fields.size()));
    }
  }
}

Json column_json(const std::vector<TableRow>& rows, std::size_t column) {
  Json values = Json::array();
  for (const TableRow& row : rows) values.push_back(brief(value_of(row, column)));
  return values;
}

/// Status as its first letter, keyframes, covariance in the world's axes, and of each camera what
/// it saw.
void add_timeline(const std::vector<TableRow>& rows, std::size_t cameras, const Pose& T_world_map,
                  Json& details) {
  std::string status;
  Json keyframes = Json::array(), covariance = Json::array();
  const Eigen::Matrix3d R = T_world_map.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TableRow& row = rows[i];
    status += row.fields[2].front();
    if (row.fields[3] == "1") keyframes.push_back(i);
    std::array<double, 6> c{};
    for (std::size_t k = 0; k < c.size(); ++k) c.at(k) = value_of(row, kCovariance + k);
    Eigen::Matrix3d m;
    m << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    covariance.push_back(covariance_json(R, m));
  }
  details["status"] = status;
  details["keyframes"] = keyframes;
  details["covariance"] = covariance;
  std::size_t column = kCameras;
  for (const char* what : {"features", "inliers", "occluded"}) {
    details[what] = Json::array();
    for (std::size_t i = 0; i < cameras; ++i) details[what].push_back(column_json(rows, column++));
  }
}

/// Numbers of the drawn frames.
Json frames_json(const std::vector<TableRow>& rows, std::size_t count, std::size_t step) {
  Json frames = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    frames.push_back(i < rows.size() ? Json(std::lround(value_of(rows[i], 1))) : Json(i * step));
  }
  return frames;
}

Json events_json(const fs::path& file) {
  Json events = Json::array();
  std::istringstream lines(text_if_there(file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty()) continue;
    check_json_depth(line, file.string());
    Json event = Json::parse(line, nullptr, false);
    if (!event.is_object() || !event.contains("t") || !event["t"].is_number() ||
        !event.contains("event") || !event["event"].is_string()) {
      fail("{}:{}: expected an object with t and event", file.string(), number);
    }
    events.push_back(std::move(event));
  }
  return events;
}

/// A run's settings, whichever command made it.
Json settings_json(const fs::path& folder) {
  for (const char* name : {"scenario.resolved.yaml", "slam.resolved.yaml"}) {
    if (is_there(folder / name)) {
      return {{"name", name}, {"text", read_file(folder / name, FileKind::kYaml)}};
    }
  }
  return nullptr;
}

Json json_if_there(const fs::path& file) {
  return is_there(file) ? read_json(file) : Json();
}

std::size_t cameras_of(const Json& site, const fs::path& file) {
  if (site.is_null()) return 0;
  if (!site.is_object() || !site.contains("cameras") || !site["cameras"].is_array()) {
    fail("{}: expected a list of cameras", file.string());
  }
  return site["cameras"].size();
}

}  // namespace

bool is_run_folder(const fs::path& folder) {
  return is_there(folder / "metrics.json") || is_there(folder / "events.jsonl");
}

Json run_details(const fs::path& folder, std::size_t most_frames) {
  Json details;
  details["site"] = json_if_there(folder / kSiteFile);
  const std::size_t cameras = cameras_of(details["site"], folder / kSiteFile);
  std::vector<TableRow> rows;
  if (cameras > 0 && is_there(folder / kTimelineFile)) rows = read_table(folder / kTimelineFile);
  expect_columns(rows, cameras);
  Paths paths = read_paths(folder, rows);
  const std::size_t step =
      std::max<std::size_t>(1, (paths.stamps.size() + most_frames - 1) / most_frames);
  paths.stamps = every_nth(paths.stamps, step);
  rows = every_nth(rows, step);
  details["step"] = step;
  details["t"] = Json::array();
  for (const Stamp stamp : paths.stamps) details["t"].push_back(decimal(to_seconds(stamp)));
  details["frame"] = frames_json(rows, paths.stamps.size(), step);
  details["truth"] = path_json(paths.stamps, paths.truth);
  details["estimate"] = path_json(paths.stamps, paths.corrected);
  details["live"] = path_json(paths.stamps, paths.live);
  details["error"] = error_json(paths.stamps, paths.truth, paths.corrected);
  details["live_error"] = error_json(paths.stamps, paths.truth, paths.live);
  if (!rows.empty()) add_timeline(rows, cameras, paths.T_world_map, details);
  details["events"] = events_json(folder / "events.jsonl");
  if (is_there(folder / kLandmarksFile)) {
    details["landmarks"] = landmarks_json(folder / kLandmarksFile, paths.T_world_map);
  }
  details["metrics"] = json_if_there(folder / "metrics.json");
  details["summary"] = text_if_there(folder / "summary.txt");
  details["settings"] = settings_json(folder);
  details["explanation"] = json_if_there(folder / "explanation.json");
  return details;
}

}  // namespace vinebench::harness
