// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/trajectory.h"
#include "sim/rover/wheel_controller.h"

namespace vinebench::harness {

/// Wheel readings without slip: from a given reading on, the angles that wheels turn which roll
/// along the true path. Without the encoders' counts.
class RollingWheels {
 public:
  explicit RollingWheels(const sim::MecanumDrive& drive) : drive_(drive) {}

  /// Replaces readings, oldest first. `path`: the true poses since the previous call's, at instants
  /// that enclose the readings. The first of all readings stays as it is.
  void replace(std::vector<WheelSample>& readings, const Trajectory& path);

 private:
  Pose at(Stamp stamp) const;

  sim::MecanumDrive drive_;
  Trajectory path_;
  std::optional<WheelSample> last_;
};

}  // namespace vinebench::harness
