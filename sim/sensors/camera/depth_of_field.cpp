// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/depth_of_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr float kSharp = 0.5f;  // px, radius of a pixel's own area

/// Radius of every pixel's disc, px.
cv::Mat radii_of_discs(const cv::Mat& depth, double focal, const DepthOfFieldConfig& lens) {
  cv::Mat radii(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    const auto* from = depth.ptr<float>(y);
    auto* to = radii.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) {
      const double radius = confusion_radius(lens, focal, static_cast<double>(from[x]));
      to[x] = std::max(kSharp, static_cast<float>(radius));
    }
  }
  return radii;
}

float distance_of(float depth) {
  return depth > 0 ? depth : std::numeric_limits<float>::max();
}

struct Neighbour {
  cv::Point offset;
  float distance;  ///< px
};

/// The pixels about one that a disc of that radius reaches.
std::vector<Neighbour> neighbours(float radius) {
  const int reach = static_cast<int>(std::ceil(radius + kSharp));
  std::vector<Neighbour> all;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const float distance = std::hypot(static_cast<float>(x), static_cast<float>(y));
      if (distance < radius + kSharp) all.push_back({{x, y}, distance});
    }
  }
  return all;
}

/// Light that a disc gives to a pixel so far from its middle, 1 in all; its edge is a pixel wide.
float share_of_disc(float radius, float distance) {
  const float covered = std::clamp(radius + kSharp - distance, 0.0f, 1.0f);
  return covered / (std::numbers::pi_v<float> * radius * radius);
}

/// The discs that the pixels of an image become.
struct Discs {
  cv::Mat light, depth, radii;

  /// Light of a pixel: the mean of the discs that reach it, by the share that each gives to it.
  cv::Vec3f at(const cv::Point& here, const std::vector<Neighbour>& about) const {
    const float own = radii.at<float>(here), distance = distance_of(depth.at<float>(here));
    const cv::Rect image({0, 0}, light.size());
    cv::Vec3f sum(0, 0, 0);
    float shares = 0;
    for (const Neighbour& step : about) {
      const cv::Point there = here + step.offset;
      if (!image.contains(there)) continue;
      float radius = radii.at<float>(there);
      if (distance_of(depth.at<float>(there)) > distance) radius = std::min(radius, own);
      const float share = share_of_disc(radius, step.distance);
      sum += share * light.at<cv::Vec3f>(there);
      shares += share;
    }
    return sum / shares;
  }
};

}  // namespace

double confusion_radius(const DepthOfFieldConfig& lens, double focal, double depth) {
  const double nearness = depth > 0 ? 1 / depth : 0;
  return std::min(kWidestConfusion,
                  0.5 * lens.aperture * focal * std::abs(1 / lens.focus - nearness));
}

void blur_by_depth(cv::Mat& codes, const cv::Mat& depth, double focal,
                   const DepthOfFieldConfig& lens) {
  const Discs discs{to_light(codes), depth, radii_of_discs(depth, focal, lens)};
  double widest = 0;
  cv::minMaxLoc(discs.radii, nullptr, &widest);
  if (widest <= static_cast<double>(kSharp)) return;
  const std::vector<Neighbour> about = neighbours(static_cast<float>(widest));
  cv::Mat blurred(codes.size(), CV_32FC3);
  for (int y = 0; y < blurred.rows; ++y) {
    for (int x = 0; x < blurred.cols; ++x) blurred.at<cv::Vec3f>(y, x) = discs.at({x, y}, about);
  }
  codes = to_codes(blurred);
}

}  // namespace vinebench::sim
