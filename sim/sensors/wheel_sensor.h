// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"
#include "core/frame.h"

namespace vinebench::sim {

/// Encoders on the wheels. They read how the wheels turn, so a wheel that slips on the ground tells
/// of a way that the rover did not go.
struct WheelSensorConfig {
  int counts_per_turn = 4096;  ///< of the wheel; 0: reads the angle itself
  template <class Archive>
  void serialize(Archive& archive) {
    archive("counts_per_turn", counts_per_turn, Range::between(0, 1e8));
  }
};

/// Turns the physics' true readings, in order, into encoders': angles in whole counts, and speeds
/// as counts since the reading before.
class WheelSensor {
 public:
  explicit WheelSensor(const WheelSensorConfig& config) : config_(config) {}
  void measure(WheelSample& sample);

 private:
  WheelSensorConfig config_;
  WheelSample before_;
};

}  // namespace vinebench::sim
