// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/config/config_field.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// What a sensor's pixels have each of their own, the same in every image. Off by default.
struct FixedPatternConfig {
  double response = 0;             ///< standard deviation of a pixel's sensitivity, share (PRNU)
  double offset = 0;               ///< standard deviation of a pixel's black, electrons (DSNU)
  double hot_pixels = 0;           ///< share of pixels that leak
  double hot_pixel_current = 1e6;  ///< electrons/s, mean of the leaks (exponentially distributed)
  template <class Archive>
  void serialize(Archive& archive) {
    archive("response", response, Range::between(0, 0.5));
    archive("offset", offset, Range::between(0, 1e5));
    archive("hot_pixels", hot_pixels, Range::between(0, 0.1));
    archive("hot_pixel_current", hot_pixel_current, Range::between(0, 1e9));
  }
  bool is_off() const { return response == 0 && offset == 0 && hot_pixels == 0; }
};

/// The pattern of one sensor, drawn by seed and camera.
class FixedPattern {
 public:
  FixedPattern(const FixedPatternConfig& config, cv::Size size, std::uint64_t seed, int camera);

  /// Onto linear light (CV_32FC3, 1 is white), in place. `exposure_time` in s; `white` is the
  /// number of electrons that make white.
  void apply(cv::Mat& light, double exposure_time, double white) const;

 private:
  struct HotPixel {
    cv::Point at;
    double current = 0;  ///< electrons/s
  };
  cv::Mat response_;  ///< CV_32FC1, about 1; empty where off
  cv::Mat offset_;    ///< CV_32FC1, electrons; empty where off
  std::vector<HotPixel> hot_pixels_;
};

/// `full_well`: electrons that make white at a gain of 0 dB. Null where off.
std::unique_ptr<LightEffect> make_fixed_pattern(const FixedPatternConfig& config, double full_well,
                                                const EffectInputs& inputs);

}  // namespace vinebench::sim
