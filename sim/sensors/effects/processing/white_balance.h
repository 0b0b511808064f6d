// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/config/config_field.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// A camera's fixed setting of its white: what it amplifies red and blue by, against green. With
/// both 1 a grey wall in the renderer's midday sun is grey.
struct WhiteBalanceConfig {
  double red = 1;   ///< amplification of red against green
  double blue = 1;  ///< likewise of blue
  template <class Archive>
  void serialize(Archive& archive) {
    archive("red", red, Range::between(0.25, 4));
    archive("blue", blue, Range::between(0.25, 4));
  }
  bool is_off() const { return red == 1 && blue == 1; }
  /// Of red, green and blue. Cameras only amplify, so that what saturates the sensor stays white:
  /// the smallest is 1.
  std::array<double, 3> gains() const;
};

/// On the linear signal, clipped at white. `gamma` is the sensor's. Null where off.
std::unique_ptr<CodeEffect> make_white_balance(const WhiteBalanceConfig& config, double gamma);

}  // namespace vinebench::sim
