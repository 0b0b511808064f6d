// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/vignette.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vinebench::sim {
namespace {

double squared_distance(const PinholeCamera& camera, double x, double y) {
  return (x - camera.cx) * (x - camera.cx) + (y - camera.cy) * (y - camera.cy);
}

double farthest_corner(const PinholeCamera& camera) {
  const double right = camera.width - 1;
  const double bottom = camera.height - 1;
  return std::max({squared_distance(camera, 0, 0), squared_distance(camera, right, 0),
                   squared_distance(camera, 0, bottom), squared_distance(camera, right, bottom)});
}

class Vignetting : public LightEffect {
 public:
  explicit Vignetting(cv::Mat share) : share_(std::move(share)) {}
  void apply(cv::Mat& light, const Shot&) const override {
    for (int y = 0; y < light.rows; ++y) {
      auto* row = light.ptr<cv::Vec3f>(y);
      const auto* share = share_.ptr<float>(y);
      for (int x = 0; x < light.cols; ++x) row[x] *= share[x];
    }
  }

 private:
  cv::Mat share_;
};

}  // namespace

cv::Mat vignette(const VignettingConfig& config, const PinholeCamera& camera) {
  const double corner = farthest_corner(camera);
  const auto& [a, b, c] = config.polynomial;
  cv::Mat share(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double cos2 = 1 / camera.unproject({x, y}).squaredNorm();
      const double r2 = squared_distance(camera, x, y) / corner;
      const double optics = 1 + r2 * (a + r2 * (b + r2 * c));
      const double natural = 1 - config.natural * (1 - cos2 * cos2);
      share.at<float>(y, x) = static_cast<float>(std::max(0.0, natural * optics));
    }
  }
  return share;
}

std::unique_ptr<LightEffect> make_vignetting(const VignettingConfig& config,
                                             const EffectInputs& inputs) {
  if (config.is_off()) return nullptr;
  return std::make_unique<Vignetting>(vignette(config, inputs.camera.model));
}

}  // namespace vinebench::sim
