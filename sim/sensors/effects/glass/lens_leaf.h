// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/config/config_field.h"
#include "sim/sensors/effects/effect.h"
#include "sim/sensors/effects/fault_scope.h"

namespace vinebench::sim {

/// A vine leaf that sticks to the front glass.
struct LensLeafConfig {
  FaultScope scope;
  Eigen::Vector2d position{0.5, 0.5};  ///< of its middle, shares of the image's width and height
  double size = 0.5;                   ///< its length, share of the image's height
  double angle_deg = 0;                ///< its tip points up at 0, to the right at 90
  double opacity = 1;                  ///< share of the light that it takes
  double blur_px = 6;                  ///< standard deviation of its edge, px
  template <class Archive>
  void serialize(Archive& archive) {
    scope.serialize(archive);
    archive("position", position, Range::between(-1, 2));
    archive("size", size, Range::between(0.01, 10));
    archive("angle_deg", angle_deg, Range::between(-360, 360));
    archive("opacity", opacity, Range::between(0, 1));
    archive("blur_px", blur_px, Range::between(0, 200));
  }
};

/// Null where none of them is on that camera.
std::unique_ptr<LightEffect> make_lens_leaves(const std::vector<LensLeafConfig>& configs,
                                              const EffectInputs& inputs);

}  // namespace vinebench::sim
