// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/config/config_field.h"
#include "core/frame.h"
#include "core/geometry/pose.h"

namespace vinebench::slam {

/// Four mecanum wheels as the estimator is told of them.
struct MecanumWheels {
  double radius = 0.10;          ///< m
  double half_track = 0.19;      ///< m, body centre to wheel centre along y
  double half_wheelbase = 0.15;  ///< m, along x

  template <class Archive>
  void serialize(Archive& archive) {
    archive("radius", radius, Range::positive());
    archive("half_track", half_track, Range::positive());
    archive("half_wheelbase", half_wheelbase, Range::positive());
  }
};

/// The body's motion since the frame before by its wheels.
struct WheelStep {
  Pose T_before_now;
  double seconds = 0;  ///< between the readings that it is told from: near those of the frames
};

/// The body's motion between two frames by its wheels: steps of forward, sideways and turning
/// motion from the encoders' angles (Taheri et al., "Kinematic model of a four mecanum wheeled
/// mobile robot", 2015, with free rollers at 45 degrees), chained. Knows no slip.
class WheelOdometry {
 public:
  explicit WheelOdometry(const MecanumWheels& wheels) : wheels_(wheels) {}

  /// Takes the readings since the frame before; gives the motion, or nothing where there are no
  /// readings to tell it from (none at all, or the first).
  std::optional<WheelStep> step(const std::vector<WheelSample>& readings);

 private:
  Pose step_between(const WheelSample& from, const WheelSample& to) const;

  MecanumWheels wheels_;
  std::optional<WheelSample> last_;
};

}  // namespace vinebench::slam
