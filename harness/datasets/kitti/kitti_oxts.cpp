// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_oxts.h"

#include <cmath>
#include <numbers>

#include "core/util/error.h"
#include "harness/datasets/files/text_table.h"
#include "harness/datasets/kitti/kitti_images.h"
#include "harness/datasets/kitti/kitti_stamps.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kEarthRadius = 6378137;  // m, at the equator
constexpr double kRadiansPerDegree = std::numbers::pi / 180;
// Columns: latitude and longitude (degrees), altitude (m), roll, pitch, yaw (rad, yaw from east),
// velocities, then acceleration (m/s²) and angular velocity (rad/s) along the unit's axes.
constexpr std::size_t kAngles = 3;
constexpr std::size_t kAcceleration = 11;
constexpr std::size_t kAngularVelocity = 17;
constexpr std::size_t kColumns = 25;  // and five of the receiver's state, which are not read

Eigen::Vector3d vector_at(const TableRow& row, std::size_t first) {
  return {row.number(first), row.number(first + 1), row.number(first + 2)};
}

TableRow read_line(const fs::path& file) {
  std::vector<TableRow> rows = read_rows(file);
  if (rows.size() != 1) fail("{}: expected one line, found {}", file.string(), rows.size());
  rows.front().expect_columns(kColumns, "latitude, longitude, altitude, roll, pitch, yaw, ...");
  return std::move(rows.front());
}

/// Metres east and north by Mercator's projection, enlarged by `scale`.
Eigen::Vector3d position_of(const TableRow& row, double scale) {
  const double latitude = row.number(0) * kRadiansPerDegree;
  const double north = std::log(std::tan(std::numbers::pi / 4 + latitude / 2));
  return {scale * kEarthRadius * row.number(1) * kRadiansPerDegree, scale * kEarthRadius * north,
          row.number(2)};
}

Eigen::Quaterniond rotation_of(const TableRow& row) {
  const Eigen::Vector3d rpy = vector_at(row, kAngles);
  return Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
}

}  // namespace

KittiOxts read_kitti_oxts(const fs::path& folder) {
  const fs::path times = folder / "timestamps.txt";
  const std::vector<Stamp> stamps = read_kitti_stamps(times);
  KittiOxts oxts;
  double scale = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (const auto& [number, file] : numbered_files(folder / "data", {".txt"})) {
    if (number >= static_cast<std::int64_t>(stamps.size())) {
      fail("{}: expected a line for {}, found {}", times.string(), file.filename().string(),
           stamps.size());
    }
    const TableRow row = read_line(file);
    const double latitude = row.number(0);
    if (std::abs(latitude) >= 90) row.fault("expected a latitude between -90 and 90 degrees");
    if (oxts.poses.empty()) {
      scale = std::cos(latitude * kRadiansPerDegree);
      origin = position_of(row, scale);
    }
    const Stamp stamp = stamps[static_cast<std::size_t>(number)];
    oxts.poses.push_back({stamp, {rotation_of(row), position_of(row, scale) - origin}});
    oxts.inertial.push_back(
        {stamp, vector_at(row, kAngularVelocity), vector_at(row, kAcceleration)});
  }
  return oxts;
}

}  // namespace vinebench::harness
