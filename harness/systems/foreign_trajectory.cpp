// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/foreign_trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/files/text_table.h"
#include "harness/judge/evaluation.h"

namespace vinebench::harness {
namespace {

constexpr double kFileNormTolerance = 0.01;                // of a quaternion
constexpr Stamp kSameFrame = kNanosecondsPerSecond / 100;  // ns, evo's rule too

Pose pose_of(const TableRow& row, bool scalar_first) {
  row.expect_columns(8, scalar_first ? "t, x, y, z, qw, qx, qy, qz" : "t x y z qx qy qz qw");
  const auto at = [&](std::size_t column) { return row.number(column); };
  Eigen::Quaterniond q = scalar_first ? Eigen::Quaterniond(at(4), at(5), at(6), at(7))
                                      : Eigen::Quaterniond(at(7), at(4), at(5), at(6));
  const double norm = q.norm();
  if (std::abs(norm - 1) > kFileNormTolerance) {
    row.fault(fmt::format("expected a unit quaternion, found norm {}", norm));
  }
  q.coeffs() /= norm;
  return {q, {at(1), at(2), at(3)}};
}

/// Throws Error for a time that no recording has.
Stamp stamp_of(const TableRow& row, bool in_seconds) {
  if (in_seconds) return row.seconds(0);
  const double time = row.number(0);
  if (!(std::abs(time) < static_cast<double>(kMostStamp))) {
    row.fault(fmt::format("expected a time in seconds or nanoseconds, found '{}'", row.fields[0]));
  }
  return static_cast<Stamp>(std::llround(time));  // may have decimals
}

/// In the file's own unit of time.
double latest(const std::vector<TableRow>& rows) {
  double time = 0;
  for (const TableRow& row : rows) time = std::max(time, row.number(0));
  return time;
}

Stamp tolerance_of(const std::vector<Stamp>& frames) {
  Stamp tolerance = kSameFrame;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    tolerance = std::min(tolerance, (frames[i] - frames[i - 1]) / 2);
  }
  return tolerance;
}

}  // namespace

Trajectory read_foreign_trajectory(const std::filesystem::path& file,
                                   const std::vector<Stamp>& frames, const Pose& T_sensor_body) {
  const std::vector<TableRow> rows = read_table(file);
  if (rows.empty() || frames.empty()) return {};
  const bool commas = read_file(file, FileKind::kTable).find(',') != std::string::npos;
  const bool in_seconds = latest(rows) <= to_seconds(frames.back()) + 1;
  Trajectory written;
  for (const TableRow& row : rows) {
    written.push_back({stamp_of(row, in_seconds), pose_of(row, commas) * T_sensor_body});
  }
  std::ranges::stable_sort(written, {}, &StampedPose::stamp);

  const Stamp tolerance = tolerance_of(frames);
  Trajectory trajectory;
  for (const Stamp frame : frames) {
    const StampedPose& nearest = nearest_in_time(written, frame);
    if (std::abs(nearest.stamp - frame) <= tolerance) trajectory.push_back({frame, nearest.pose});
  }
  if (trajectory.empty()) {
    fail(
        "{}: none of its {} poses matches a frame: they are from {} to {} s, the frames from {} to "
        "{} s",
        file.string(), written.size(), format_seconds(written.front().stamp),
        format_seconds(written.back().stamp), format_seconds(frames.front()),
        format_seconds(frames.back()));
  }
  return trajectory;
}

}  // namespace vinebench::harness
