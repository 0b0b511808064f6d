// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/stereo_matcher.h"

#include <algorithm>
#include <cmath>

#include "core/util/error.h"
#include "slam/stereo/row_search.h"

namespace vinebench::slam {
namespace {

/// Search and search back agree to this.
constexpr int kReturnTolerance = 1;  // px

/// One pyramid level of a pair.
struct LevelPair {
  const cv::Mat& left;
  const cv::Mat& right;
  int max_disparity;  ///< px of this level
};

/// Whole disparity of the window about (x, y), or -1 where it is not unique or not mutual.
int search_disparity(const LevelPair& level, int x, int y, double uniqueness) {
  const RowSearch there = search_row(level.left, x, y, level.right, x - level.max_disparity,
                                     x + kReturnTolerance, uniqueness);
  if (there.column < 0 || there.best * uniqueness > there.second) return -1;
  const RowSearch back =
      search_row(level.right, there.column, y, level.left, there.column - kReturnTolerance,
                 there.column + level.max_disparity, 0);
  const bool mutual = back.column >= 0 && std::abs(back.column - x) <= kReturnTolerance;
  return mutual ? std::max(0, x - there.column) : -1;
}

}  // namespace

std::vector<StereoMatch> match_stereo(const Extraction& left,
                                      const std::vector<cv::Mat>& right_pyramid,
                                      const PinholeCamera& camera, double baseline,
                                      const OrbExtractor& extractor, const StereoConfig& config) {
  if (!(baseline > 0)) fail("stereo matching: expected a baseline above 0 m, found {}", baseline);
  if (left.pyramid.empty() || right_pyramid.empty() ||
      left.pyramid.front().size() != right_pyramid.front().size()) {
    fail("stereo matching: expected two images of the same size");
  }
  const double focal_baseline = camera.fx * baseline;
  std::vector<StereoMatch> matches(left.features.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Keypoint& seen = left.features.keypoints[i];
    const auto l = static_cast<std::size_t>(seen.level);
    const double scale = extractor.scale_of(seen.level);
    const auto on_level = [scale](float v) {
      return static_cast<int>(std::lround((static_cast<double>(v) + 0.5) / scale - 0.5));
    };
    const int x = on_level(seen.x);
    const int y = on_level(seen.y);
    const int farthest = static_cast<int>(focal_baseline / (config.min_depth * scale));
    const int whole =
        search_disparity({left.pyramid[l], right_pyramid[l], farthest}, x, y, config.uniqueness);
    if (whole < 0) continue;
    const auto aligned = align_patch(left.pyramid[l], right_pyramid[l], x, y, whole);
    if (!aligned || !config.accepts(*aligned)) continue;
    const double disparity = aligned->shift * scale;
    if (disparity <= 0) continue;
    const double depth = focal_baseline / disparity;
    matches[i].x_right = static_cast<float>(static_cast<double>(seen.x) - disparity);
    matches[i].slant_x = static_cast<float>(aligned->slope_x / disparity);
    matches[i].slant_y = static_cast<float>(aligned->slope_y / disparity);
    if (depth < config.max_depth_baselines * baseline) matches[i].depth = static_cast<float>(depth);
  }
  return matches;
}

void reach_farther(const Features& left, const PinholeCamera& camera, double baseline,
                   const StereoConfig& config, std::vector<StereoMatch>& matches) {
  const auto near =
      std::ranges::count_if(matches, [](const StereoMatch& m) { return m.depth > 0; });
  if (near >= config.few) return;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].depth > 0 || matches[i].x_right < 0) continue;
    const float disparity = left.keypoints[i].x - matches[i].x_right;
    const double depth = camera.fx * baseline / static_cast<double>(disparity);
    if (depth < config.far_depth_baselines * baseline) {
      matches[i].depth = static_cast<float>(depth);
    }
  }
}

}  // namespace vinebench::slam
