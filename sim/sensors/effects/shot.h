// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "core/time.h"
#include "sim/render/render_engine.h"

namespace vinebench::sim {

/// What one image is taken with.
struct Exposure {
  double time = 0;     ///< s
  double gain_db = 0;  ///< dB

  double gain() const { return std::pow(10.0, gain_db / 20); }
  /// Signal against that of the reference time at 0 dB.
  double factor(double reference_time) const { return time / reference_time * gain(); }
};

/// One image to take.
struct Shot {
  std::int64_t frame = 0;
  Stamp instant = 0;  ///< the middle of the middle row's exposure
  Exposure exposure;
  RenderRequest request;  ///< beside the colours; the camera sets exposure, time and rover
};

}  // namespace vinebench::sim
