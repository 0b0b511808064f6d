// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glass/lens_cover.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace vinebench::sim {
namespace {

constexpr int kShift = 4;  // fraction bits of the drawing functions' coordinates

cv::Point fixed_point(double x, double y) {
  return {static_cast<int>(std::lround(x * (1 << kShift))),
          static_cast<int>(std::lround(y * (1 << kShift)))};
}

class CoverEffect : public LightEffect {
 public:
  explicit CoverEffect(std::vector<LensCover> covers) : covers_(std::move(covers)) {}
  bool is_active(Stamp instant) const override {
    return std::ranges::any_of(covers_,
                               [&](const LensCover& c) { return c.scope.is_active(instant); });
  }
  void apply(cv::Mat& light, const Shot& shot) const override {
    for (const LensCover& cover : covers_) {
      if (cover.scope.is_active(shot.instant)) cover.apply(light);
    }
  }

 private:
  std::vector<LensCover> covers_;
};

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

void fill_shape(cv::Mat& map, const std::vector<cv::Point2d>& outline, double opacity) {
  std::vector<cv::Point> corners;
  corners.reserve(outline.size());
  for (const cv::Point2d& corner : outline) corners.push_back(fixed_point(corner.x, corner.y));
  cv::fillPoly(map, std::vector<std::vector<cv::Point>>{corners}, opacity, cv::LINE_8, kShift);
}

void defocus(cv::Mat& map, double sigma) {
  if (sigma > 0) cv::GaussianBlur(map, map, {}, sigma, sigma, cv::BORDER_REPLICATE);
}

std::unique_ptr<LightEffect> make_cover_effect(std::vector<LensCover> covers) {
  if (covers.empty()) return nullptr;
  return std::make_unique<CoverEffect>(std::move(covers));
}

}  // namespace vinebench::sim
