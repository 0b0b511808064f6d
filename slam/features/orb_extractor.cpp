// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/orb_extractor.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"
#include "slam/features/fast_cells.h"
#include "slam/features/orb_descriptor.h"
#include "slam/features/smoothing.h"
#include "slam/features/square_covering.h"

namespace vinebench::slam {
namespace {

/// Shares `features` among the levels so that each has 1 / scale of the one before.
std::vector<int> share_among_levels(int features, int levels, double scale) {
  double sum = 0;
  for (int level = 0; level < levels; ++level) sum += std::pow(scale, -level);
  std::vector<int> shares;
  int left = features;
  for (int level = 0; level + 1 < levels; ++level) {
    shares.push_back(static_cast<int>(std::lround(features / sum * std::pow(scale, -level))));
    left -= shares.back();
  }
  shares.push_back(std::max(0, left));
  return shares;
}

/// Each level from the one above. The factor rather than the size is given to resize, so that
/// x_above = (x + 0.5) * scale - 0.5 holds exactly whatever the rounding of the size.
std::vector<cv::Mat> build_pyramid(const cv::Mat& grey, int levels, double scale) {
  std::vector<cv::Mat> pyramid{grey};
  for (int level = 1; level < levels; ++level) {
    const cv::Mat& above = pyramid.back();
    if (above.cols < 2 * scale || above.rows < 2 * scale) break;
    cv::Mat smaller;
    cv::resize(above, smaller, cv::Size(), 1 / scale, 1 / scale, cv::INTER_LINEAR);
    pyramid.push_back(smaller);
  }
  return pyramid;
}

/// Directions and descriptors of the corners of one level, appended to `features`.
void describe(const cv::Mat& image, int level, double scale, const std::vector<Corner>& corners,
              Features& features) {
  if (corners.empty()) return;
  const cv::Mat smoothed = smooth(image);
  for (const Corner& corner : corners) {
    Keypoint keypoint;
    keypoint.x = static_cast<float>((corner.x + 0.5) * scale - 0.5);
    keypoint.y = static_cast<float>((corner.y + 0.5) * scale - 0.5);
    keypoint.angle = centroid_angle(image, corner.x, corner.y);
    keypoint.response = static_cast<float>(corner.score);
    keypoint.level = level;
    features.keypoints.push_back(keypoint);
    features.descriptors.push_back(rotated_brief(smoothed, corner.x, corner.y, keypoint.angle));
  }
}

}  // namespace

OrbExtractor::OrbExtractor(const OrbConfig& config)
    : config_(config),
      features_per_level_(share_among_levels(config.features, config.levels, config.scale)) {
  for (int level = 0; level < config.levels; ++level) {
    scales_.push_back(std::pow(config.scale, level));
  }
}

std::vector<cv::Mat> OrbExtractor::pyramid(const cv::Mat& grey) const {
  if (grey.type() != CV_8UC1 || grey.empty()) {
    fail("ORB extraction: expected a grey image of 8 bits (CV_8UC1), found {} x {} of type {}",
         grey.cols, grey.rows, cv::typeToString(grey.type()));
  }
  return build_pyramid(grey, config_.levels, config_.scale);
}

Extraction OrbExtractor::extract(const cv::Mat& grey) const {
  Extraction result;
  result.pyramid = pyramid(grey);
  const FastCellsConfig fast{config_.fast_threshold, config_.fast_threshold_min, config_.cell,
                             config_.edge};
  for (std::size_t level = 0; level < result.pyramid.size(); ++level) {
    const cv::Mat& image = result.pyramid[level];
    const std::vector<Corner> corners = suppress_square_covering(
        detect_fast_cells(image, fast), features_per_level_[level], image.cols, image.rows);
    describe(image, static_cast<int>(level), scales_[level], corners, result.features);
  }
  return result;
}

}  // namespace vinebench::slam
