// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glass/lens_leaf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/sensors/effects/glass/lens_cover.h"

namespace vinebench::sim {
namespace {

/// Radius of a vine leaf's outline at an angle off its tip, 1 at the tip: a broad blade with five
/// toothed lobes and a deep notch at the stalk.
double leaf_radius(double angle) {
  struct Lobe {
    double angle, length;
  };
  constexpr std::array<Lobe, 5> kLobes{
      {{0, 1.0}, {1.02, 0.92}, {-1.02, 0.92}, {2.05, 0.80}, {-2.05, 0.80}}};
  const double a = std::remainder(angle, 2 * std::numbers::pi);
  double blade = 0;
  for (const Lobe& lobe : kLobes) {
    const double off = (a - lobe.angle) / 0.40;
    blade = std::max(blade, lobe.length * (0.66 + 0.34 * std::exp(-off * off)));
  }
  const double from_stalk = (std::numbers::pi - std::abs(a)) / 0.42;
  const double notch = 1 - 0.85 * std::exp(-from_stalk * from_stalk);
  return blade * notch * (1 + 0.045 * std::cos(38 * a));
}

LensCover cover_of(const LensLeafConfig& config, cv::Size size) {
  constexpr int kCorners = 720;
  // From the stalk's notch to the tip a leaf is about 1.6 of its tip's radius long.
  const double scale = config.size * size.height / 1.6;
  const double turn = config.angle_deg * std::numbers::pi / 180;
  std::vector<cv::Point2d> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    const double r = scale * leaf_radius(a);
    outline.emplace_back(config.position.x() * size.width + r * std::sin(a + turn),
                         config.position.y() * size.height - r * std::cos(a + turn));
  }
  const cv::Vec3f backlit(0.13f, 0.24f, 0.04f);
  LensCover cover{config.scope, cv::Mat::zeros(size, CV_32FC1), backlit};
  fill_shape(cover.opacity, outline, config.opacity);
  defocus(cover.opacity, config.blur_px);
  return cover;
}

}  // namespace

std::unique_ptr<LightEffect> make_lens_leaves(const std::vector<LensLeafConfig>& configs,
                                              const EffectInputs& inputs) {
  std::vector<LensCover> covers;
  for (const LensLeafConfig& config : configs) {
    if (config.scope.applies_to(inputs.camera.name)) {
      covers.push_back(cover_of(config, inputs.size()));
    }
  }
  return make_cover_effect(std::move(covers));
}

}  // namespace vinebench::sim
