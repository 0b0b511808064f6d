// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/config/config_field.h"
#include "sim/sensors/effects/effect.h"
#include "sim/sensors/effects/fault_scope.h"

namespace vinebench::sim {

/// Specks of dust and mud on the front glass, far out of focus; where they are is drawn by seed and
/// camera.
struct LensDirtConfig {
  FaultScope scope;
  int count = 40;                          ///< number of spots
  std::array<double, 2> radius_px{8, 45};  ///< least and greatest, px; small ones are many
  double opacity = 0.8;                    ///< greatest share of the light that a speck takes
  double blur_px = 7;                      ///< standard deviation of its edge, px
  double glow = 0.35;        ///< light that a speck scatters into the lens, of the image's mean
  std::int64_t pattern = 0;  ///< another number, another pattern
  template <class Archive>
  void serialize(Archive& archive) {
    scope.serialize(archive);
    archive("count", count, Range::between(0, 10000));
    archive("radius_px", radius_px, Range::between(0.5, 2000));
    archive("opacity", opacity, Range::between(0, 1));
    archive("blur_px", blur_px, Range::between(0, 200));
    archive("glow", glow, Range::between(0, 1));
    archive("pattern", pattern, Range::non_negative());
    archive.require(radius_px[0] <= radius_px[1], "radius_px", "expected the lesser one first");
  }
};

/// Null where none of them is on that camera.
std::unique_ptr<LightEffect> make_lens_dirt(const std::vector<LensDirtConfig>& configs,
                                            const EffectInputs& inputs);

}  // namespace vinebench::sim
