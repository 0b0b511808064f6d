// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/fixed_pattern.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/util/random.h"

namespace vinebench::sim {
namespace {

/// A normal draw a pixel; empty where sigma is 0.
cv::Mat normal_map(cv::Size size, double mean, double sigma, const RandomStream& stream) {
  if (sigma == 0) return {};
  cv::Mat map(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(size.width) +
                         static_cast<std::uint64_t>(x);
      map.at<float>(y, x) = static_cast<float>(mean + sigma * stream.normal(index));
    }
  }
  return map;
}

class FixedPatternEffect : public LightEffect {
 public:
  FixedPatternEffect(FixedPattern pattern, double full_well)
      : pattern_(std::move(pattern)), full_well_(full_well) {}
  void apply(cv::Mat& light, const Shot& shot) const override {
    pattern_.apply(light, shot.exposure.time, full_well_ / shot.exposure.gain());
  }

 private:
  FixedPattern pattern_;
  double full_well_;
};

}  // namespace

FixedPattern::FixedPattern(const FixedPatternConfig& config, cv::Size size, std::uint64_t seed,
                           int camera) {
  const std::string end = fmt::format(".{}", camera);
  response_ =
      normal_map(size, 1, config.response, RandomStream(seed, "sensor.pixel_response" + end));
  offset_ = normal_map(size, 0, config.offset, RandomStream(seed, "sensor.pixel_offset" + end));
  const RandomStream hot(seed, "sensor.hot_pixels" + end);
  const auto count = static_cast<std::uint64_t>(std::llround(config.hot_pixels * size.area()));
  for (std::uint64_t i = 0; i < count; ++i) {
    const cv::Point at(static_cast<int>(hot.uniform(3 * i) * size.width),
                       static_cast<int>(hot.uniform(3 * i + 1) * size.height));
    const double current = -config.hot_pixel_current * std::log1p(-hot.uniform(3 * i + 2));
    hot_pixels_.push_back({at, current});
  }
}

void FixedPattern::apply(cv::Mat& light, double exposure_time, double white) const {
  const auto scale = static_cast<float>(1 / white);
  for (int y = 0; y < light.rows; ++y) {
    auto* row = light.ptr<cv::Vec3f>(y);
    const auto* response = response_.empty() ? nullptr : response_.ptr<float>(y);
    const auto* offset = offset_.empty() ? nullptr : offset_.ptr<float>(y);
    for (int x = 0; x < light.cols; ++x) {
      if (response != nullptr) row[x] *= response[x];
      if (offset != nullptr) row[x] += cv::Vec3f::all(scale * offset[x]);
    }
  }
  for (const HotPixel& pixel : hot_pixels_) {
    const auto leak = static_cast<float>(pixel.current * exposure_time / white);
    light.at<cv::Vec3f>(pixel.at) += cv::Vec3f::all(leak);
  }
}

std::unique_ptr<LightEffect> make_fixed_pattern(const FixedPatternConfig& config, double full_well,
                                                const EffectInputs& inputs) {
  if (config.is_off()) return nullptr;
  return std::make_unique<FixedPatternEffect>(
      FixedPattern(config, inputs.size(), inputs.seed, inputs.index), full_well);
}

}  // namespace vinebench::sim
