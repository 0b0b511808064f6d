// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/stereo_matcher.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/util/error.h"
#include "slam/stereo/feature_search.h"
#include "slam/stereo/row_search.h"

namespace vinebench::slam {
namespace {

/// Search and search back agree to this.
constexpr int kReturnTolerance = 1;  // px

/// Of windows that are found through clean lenses, half to nine in ten agree; with 80 specks on
/// each of two, one in nine.
constexpr std::size_t kDirtyShare = 4;
/// Of images that share nothing, one feature in 25 finds such a window by chance.
constexpr std::size_t kChanceShare = 10;
/// Dirt leaves at least this share of StereoConfig::few to find; a cover close to a lens does not.
constexpr std::size_t kLeastShare = 2;

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

/// A feature's place in the right image.
struct Found {
  double disparity;    ///< px of level 0
  double slope_x = 0;  ///< change of the disparity, px a px
  double slope_y = 0;
};

/// Pyramids of a pair and what they show.
struct WindowSearch {
  const std::vector<cv::Mat>& left;
  const std::vector<cv::Mat>& right;
  double focal_baseline;  ///< px m
  const OrbExtractor& extractor;
  const StereoConfig& config;

  std::optional<Found> find(const Keypoint& seen) const {
    const auto l = static_cast<std::size_t>(seen.level);
    const double scale = extractor.scale_of(seen.level);
    const auto on_level = [scale](float v) {
      return static_cast<int>(std::lround((static_cast<double>(v) + 0.5) / scale - 0.5));
    };
    const int x = on_level(seen.x);
    const int y = on_level(seen.y);
    const int farthest = static_cast<int>(focal_baseline / (config.min_depth * scale));
    const int whole = search_disparity({left[l], right[l], farthest}, x, y, config.uniqueness);
    if (whole < 0) return std::nullopt;
    const auto aligned = align_patch(left[l], right[l], x, y, whole);
    if (!aligned || !config.accepts(*aligned)) return std::nullopt;
    return Found{aligned->shift * scale, aligned->slope_x, aligned->slope_y};
  }
};

}  // namespace

std::size_t count_found(const std::vector<StereoMatch>& matches) {
  return static_cast<std::size_t>(
      std::ranges::count_if(matches, [](const StereoMatch& m) { return m.x_right >= 0; }));
}

int count_with_depth(const std::vector<StereoMatch>& matches) {
  return static_cast<int>(
      std::ranges::count_if(matches, [](const StereoMatch& m) { return m.depth > 0; }));
}

std::vector<StereoMatch> match_stereo(const Extraction& left, const Extraction& right,
                                      const PinholeCamera& camera, double baseline,
                                      const OrbExtractor& extractor, const StereoConfig& config) {
  if (!(baseline > 0)) fail("stereo matching: expected a baseline above 0 m, found {}", baseline);
  if (left.pyramid.empty() || right.pyramid.empty() ||
      left.pyramid.front().size() != right.pyramid.front().size()) {
    fail("stereo matching: expected two images of the same size");
  }
  const double focal_baseline = camera.fx * baseline;
  const WindowSearch windows{left.pyramid, right.pyramid, focal_baseline, extractor, config};
  std::optional<FeatureSearch> features;
  if (config.search == StereoSearch::kFeatures) {
    features.emplace(right.features, left.pyramid.front().rows, extractor);
  }
  std::vector<StereoMatch> matches(left.features.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Keypoint& seen = left.features.keypoints[i];
    std::optional<Found> found;
    if (!features) {
      found = windows.find(seen);
    } else if (const auto disparity = features->disparity_of(seen, left.features.descriptors[i],
                                                             focal_baseline / config.min_depth)) {
      found = Found{*disparity};
    }
    if (!found || found->disparity <= 0) continue;
    const double depth = focal_baseline / found->disparity;
    matches[i].x_right = static_cast<float>(static_cast<double>(seen.x) - found->disparity);
    matches[i].slant_x = static_cast<float>(found->slope_x / found->disparity);
    matches[i].slant_y = static_cast<float>(found->slope_y / found->disparity);
    if (depth < config.max_depth_baselines * baseline) matches[i].depth = static_cast<float>(depth);
  }
  return matches;
}

bool is_dirty(const std::vector<StereoMatch>& matches, const std::vector<StereoMatch>& looser,
              const StereoConfig& config) {
  const std::size_t agree = count_found(matches);
  const std::size_t found = count_found(looser);
  const auto few = static_cast<std::size_t>(config.few);
  return agree < few && agree * kDirtyShare < found && found * kLeastShare >= few &&
         found * kChanceShare > looser.size();
}

}  // namespace vinebench::slam
