// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/groundtruth.h"

#include <algorithm>
#include <cmath>

#include "core/util/error.h"
#include "harness/datasets/files/text_table.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;
constexpr double kRotationTolerance = 0.01;  // of an entry of R R^T, of a quaternion's norm

Pose kitti_pose(const TableRow& row) {
  Eigen::Matrix<double, 3, 4> T;
  for (std::size_t i = 0; i < kKittiColumns; ++i) {
    T(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = row.number(i);
  }
  const Eigen::Matrix3d R = T.leftCols<3>();
  if (!is_rotation(R, kRotationTolerance)) {
    row.fault("expected a rotation matrix in columns 1-3, 5-7 and 9-11");
  }
  return {Eigen::Quaterniond(R).normalized(), T.col(3)};
}

/// A stamp with at least thirteen digits is in ns: as seconds it would be beyond the year 300,000.
bool has_nanoseconds(const TableRow& row) {
  const std::string& stamp = row.fields.front();
  return stamp.size() >= 13 && stamp.find_first_not_of("0123456789") == std::string::npos;
}

/// Lines are associated with frames by number.
Trajectory kitti_truth(const std::vector<TableRow>& rows, Recording& recording) {
  const Pose T_cam_body = recording.T_body_left.inverse();
  // KITTI's world is the first camera's frame; ours has z up.
  const Pose T_world_kitti = Rig::mount(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  Trajectory truth;
  for (std::size_t i = 0; i < std::min(rows.size(), recording.frames.size()); ++i) {
    rows[i].expect_columns(kKittiColumns, "3 x 4, row by row");
    truth.push_back({recording.frames[i].stamp, T_world_kitti * kitti_pose(rows[i]) * T_cam_body});
  }
  if (rows.size() != recording.frames.size()) {
    recording.frames.back().events.push_back(
        {"groundtruth_length", "groundtruth",
         fmt::format("{}: {} poses for {} frames", rows.front().file.string(), rows.size(),
                     recording.frames.size())});
  }
  return truth;
}

}  // namespace

Trajectory read_euroc_poses(const std::filesystem::path& file, const Pose& T_body_sensor) {
  Trajectory truth;
  for (const TableRow& row : read_table(file)) {
    row.expect_columns(8, "ns, x, y, z, qw, qx, qy, qz");
    const auto at = [&](std::size_t column) { return row.number(column); };
    Eigen::Quaterniond q(at(4), at(5), at(6), at(7));
    const double norm = q.norm();
    if (std::abs(norm - 1) > kRotationTolerance) {
      row.fault(fmt::format("expected a unit quaternion, found norm {}", norm));
    }
    q.coeffs() /= norm;
    const Pose T_world_sensor{q, {at(1), at(2), at(3)}};
    truth.push_back({row.nanoseconds(0), T_world_sensor * T_body_sensor.inverse()});
  }
  std::ranges::stable_sort(truth, {}, &StampedPose::stamp);
  const auto repeated = std::unique(
      truth.begin(), truth.end(), [](const auto& a, const auto& b) { return a.stamp == b.stamp; });
  truth.erase(repeated, truth.end());
  return truth;
}

Trajectory read_groundtruth(const std::filesystem::path& file, Recording& recording) {
  const std::vector<TableRow> rows = read_table(file);
  if (rows.empty()) fail("{}: expected poses, found none", file.string());
  const std::size_t columns = rows.front().fields.size();
  if (columns == kKittiColumns) return kitti_truth(rows, recording);
  if (columns == kTumColumns && !has_nanoseconds(rows.back())) return read_tum(file);
  if (columns >= kTumColumns) return read_euroc_poses(file, Pose{});
  fail("{}:{}: expected 8 columns (TUM: t x y z qx qy qz qw), 12 (KITTI) or 17 (EuRoC), found {}",
       file.string(), rows.front().line, columns);
}

}  // namespace vinebench::harness
