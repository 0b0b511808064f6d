// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"
#include "core/frame.h"

namespace vinebench::sim {

/// Wheel encoders. They read the rotation of the wheels, which includes slip.
struct WheelSensorConfig {
  int counts_per_turn = 4096;  ///< of the wheel; 0: exact angle
  template <class Archive>
  void serialize(Archive& archive) {
    archive("counts_per_turn", counts_per_turn, Range::between(0, 1e8));
  }
};

/// Converts the physics' true readings, in order, to encoder readings: angles in integer counts,
/// speeds as counts since the previous reading.
class WheelSensor {
 public:
  explicit WheelSensor(const WheelSensorConfig& config) : config_(config) {}
  void measure(WheelSample& sample);

 private:
  WheelSensorConfig config_;
  WheelSample before_;
};

}  // namespace vinebench::sim
