// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/config/config_field.h"
#include "core/geometry/camera.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// How light falls off towards the image's corners; both laws multiply.
struct VignettingConfig {
  /// Share of the natural law of cos^4 of the angle to the optical axis: 0 none of it, 1 all.
  double natural = 0;
  /// a, b, c of 1 + a r^2 + b r^4 + c r^6, where r = 1 in the corner farthest from the principal
  /// point.
  std::array<double, 3> polynomial{};
  template <class Archive>
  void serialize(Archive& archive) {
    archive("natural", natural, Range::between(0, 1));
    archive("polynomial", polynomial, Range::between(-10, 10));
  }
  bool is_off() const { return natural == 0 && polynomial == std::array<double, 3>{}; }
};

/// What share of its light each pixel gets, CV_32FC1, at least 0.
cv::Mat vignette(const VignettingConfig& config, const PinholeCamera& camera);

/// Null where off.
std::unique_ptr<LightEffect> make_vignetting(const VignettingConfig& config,
                                             const EffectInputs& inputs);

}  // namespace vinebench::sim
