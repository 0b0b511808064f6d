// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/wheel_sensor.h"

#include <cmath>
#include <numbers>

namespace vinebench::sim {

void WheelSensor::measure(WheelSample& sample) {
  if (config_.counts_per_turn == 0) return;
  const double count = 2 * std::numbers::pi / config_.counts_per_turn;  // rad
  const double seconds = to_seconds(sample.stamp - before_.stamp);
  for (std::size_t i = 0; i < sample.angle.size(); ++i) {
    sample.angle[i] = count * std::round(sample.angle[i] / count);
    sample.velocity[i] = seconds > 0 ? (sample.angle[i] - before_.angle[i]) / seconds : 0;
  }
  before_ = sample;
}

}  // namespace vinebench::sim
