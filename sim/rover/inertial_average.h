// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/frame.h"

namespace vinebench::sim {

/// The mean of what an inertial unit feels between two readings, as a unit's own filter gives it,
/// so that readings sum up to the motion: rollers shake the body at frequencies that single values
/// would alias.
class InertialAverage {
 public:
  /// What the unit feels in one more step of the physics.
  void add(const ImuSample& felt) {
    sum_.angular_velocity += felt.angular_velocity;
    sum_.specific_force += felt.specific_force;
    ++steps_;
  }

  /// The reading at `stamp`: the mean since the one before, or `latest` where no step was added.
  ImuSample take(Stamp stamp, const ImuSample& latest) {
    ImuSample reading = steps_ > 0 ? sum_ : latest;
    reading.stamp = stamp;
    if (steps_ > 0) {
      reading.angular_velocity /= steps_;
      reading.specific_force /= steps_;
    }
    *this = {};
    return reading;
  }

 private:
  ImuSample sum_;
  int steps_ = 0;
};

}  // namespace vinebench::sim
