// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/lens_dirt.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/util/random.h"

namespace vinebench::sim {
namespace {

constexpr int kShift = 4;  // fraction bits of the drawing functions' coordinates

cv::Point fixed_point(double x, double y) {
  return {static_cast<int>(std::lround(x * (1 << kShift))),
          static_cast<int>(std::lround(y * (1 << kShift)))};
}

void blur(cv::Mat& map, double sigma) {
  if (sigma > 0) cv::GaussianBlur(map, map, {}, sigma, sigma, cv::BORDER_REPLICATE);
}

/// A speck is a round blob with a dent or two.
std::vector<cv::Point> speck_outline(const Eigen::Vector2d& middle, double radius,
                                     RandomSequence& random) {
  constexpr int kCorners = 24;
  const double phase_2 = random.uniform(0, 2 * std::numbers::pi);
  const double phase_3 = random.uniform(0, 2 * std::numbers::pi);
  const double dent = random.uniform(0.05, 0.25);
  std::vector<cv::Point> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    const double r =
        radius * (1 + dent * std::cos(2 * a + phase_2) + dent * std::cos(3 * a + phase_3));
    outline.push_back(fixed_point(middle.x() + r * std::cos(a), middle.y() + r * std::sin(a)));
  }
  return outline;
}

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

}  // namespace

void LensCover::apply(cv::Mat& light) const {
  const cv::Scalar mean = cv::mean(light);
  const auto ambient = static_cast<float>((mean[0] + mean[1] + mean[2]) / 3);
  const cv::Vec3f own = ambient * glow;
  for (int y = 0; y < light.rows; ++y) {
    auto* row = light.ptr<cv::Vec3f>(y);
    const auto* share = opacity.ptr<float>(y);
    for (int x = 0; x < light.cols; ++x) {
      if (share[x] > 0) row[x] += share[x] * (own - row[x]);
    }
  }
}

LensCover make_lens_dirt(const LensDirtConfig& config, cv::Size size, std::uint64_t seed,
                         int camera) {
  RandomSequence random(RandomStream(seed, "lens.dirt." + std::to_string(camera),
                                     static_cast<std::uint64_t>(config.pattern)));
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
    cv::fillPoly(speck, std::vector<std::vector<cv::Point>>{speck_outline(middle, radius, random)},
                 opacity, cv::LINE_8, kShift);
    cover.opacity = cv::max(cover.opacity, speck);
  }
  blur(cover.opacity, config.blur_px);
  return cover;
}

LensCover make_lens_leaf(const LensLeafConfig& config, cv::Size size) {
  constexpr int kCorners = 720;
  // From the stalk's notch to the tip a leaf is about 1.6 of its tip's radius long.
  const double scale = config.size * size.height / 1.6;
  const double turn = config.angle_deg * std::numbers::pi / 180;
  std::vector<cv::Point> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    const double r = scale * leaf_radius(a);
    outline.push_back(fixed_point(config.position.x() * size.width + r * std::sin(a + turn),
                                  config.position.y() * size.height - r * std::cos(a + turn)));
  }
  const cv::Vec3f backlit(0.13f, 0.24f, 0.04f);
  LensCover cover{config.scope, cv::Mat::zeros(size, CV_32FC1), backlit};
  cv::fillPoly(cover.opacity, std::vector<std::vector<cv::Point>>{outline}, config.opacity,
               cv::LINE_8, kShift);
  blur(cover.opacity, config.blur_px);
  return cover;
}

}  // namespace vinebench::sim
