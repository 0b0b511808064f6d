// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "sim/sensors/effects/effect.h"

namespace vinebench::test {

/// A camera of 120 x 90 pixels with its light, as the makers of effects take it.
struct EffectCamera {
  RigCamera camera{"left", {120, 90, 100, 100, 59.5, 44.5, {}}, {}};
  sim::Light light;

  sim::EffectInputs inputs(int index = 0, std::uint64_t seed = 1) const {
    return {camera, index, seed, light};
  }
  cv::Size size() const { return {camera.model.width, camera.model.height}; }
  cv::Mat even_light(double value) const { return {size(), CV_32FC3, cv::Scalar::all(value)}; }
};

inline sim::Shot shot_at(double seconds, double exposure_time = 0.002, double gain_db = 0) {
  sim::Shot shot;
  shot.instant = from_seconds(seconds);
  shot.exposure = {exposure_time, gain_db};
  return shot;
}

/// What the effect makes of even light.
inline cv::Mat applied(const sim::LightEffect& effect, const EffectCamera& camera, double value,
                       const sim::Shot& shot = shot_at(0)) {
  cv::Mat light = camera.even_light(value);
  effect.apply(light, shot);
  return light;
}

/// One channel of an image.
inline cv::Mat channel(const cv::Mat& image, int index) {
  cv::Mat single;
  cv::extractChannel(image, single, index);
  return single;
}

/// Values of an image, of any channel, that differ from the other's.
inline int different_values(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(cv::Mat(a != b).reshape(1));
}

}  // namespace vinebench::test
