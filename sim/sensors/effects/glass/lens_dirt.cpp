// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glass/lens_dirt.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>

#include "core/util/random.h"
#include "sim/sensors/effects/glass/lens_cover.h"

namespace vinebench::sim {
namespace {

/// A speck is a round blob with a dent or two.
std::vector<cv::Point2d> speck_outline(const Eigen::Vector2d& middle, double radius,
                                       RandomSequence& random) {
  constexpr int kCorners = 24;
  const double phase_2 = random.uniform(0, 2 * std::numbers::pi);
  const double phase_3 = random.uniform(0, 2 * std::numbers::pi);
  const double dent = random.uniform(0.05, 0.25);
  std::vector<cv::Point2d> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    const double r =
        radius * (1 + dent * std::cos(2 * a + phase_2) + dent * std::cos(3 * a + phase_3));
    outline.emplace_back(middle.x() + r * std::cos(a), middle.y() + r * std::sin(a));
  }
  return outline;
}

LensCover cover_of(const LensDirtConfig& config, const EffectInputs& inputs) {
  RandomSequence random(RandomStream(inputs.seed, "lens.dirt." + std::to_string(inputs.index),
                                     static_cast<std::uint64_t>(config.pattern)));
  const cv::Size size = inputs.size();
  const cv::Vec3f dust(1.1f, 1.0f, 0.85f);
  LensCover cover{config.scope, cv::Mat::zeros(size, CV_32FC1),
                  static_cast<float>(config.glow) * dust};
  for (int i = 0; i < config.count; ++i) {
    const Eigen::Vector2d middle(random.uniform(0, size.width), random.uniform(0, size.height));
    const double share = random.uniform();
    const double radius =
        config.radius_px[0] + (config.radius_px[1] - config.radius_px[0]) * share * share;
    const double opacity = config.opacity * random.uniform(0.35, 1);
    cv::Mat speck = cv::Mat::zeros(size, CV_32FC1);
    fill_shape(speck, speck_outline(middle, radius, random), opacity);
    cover.opacity = cv::max(cover.opacity, speck);
  }
  defocus(cover.opacity, config.blur_px);
  return cover;
}

}  // namespace

std::unique_ptr<LightEffect> make_lens_dirt(const std::vector<LensDirtConfig>& configs,
                                            const EffectInputs& inputs) {
  std::vector<LensCover> covers;
  for (const LensDirtConfig& config : configs) {
    if (config.scope.applies_to(inputs.camera.name)) covers.push_back(cover_of(config, inputs));
  }
  return make_cover_effect(std::move(covers));
}

}  // namespace vinebench::sim
