// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo_matcher.h"

#include <algorithm>
#include <cmath>

#include "slam/base/error.h"
#include "slam/patch_alignment.h"

namespace vinebench {
namespace {

constexpr double kMinDepth = 0.15;               ///< m; nothing is nearer in the narrowest aisle
constexpr double kRowTolerance = 2.0;            ///< px of the right keypoint's level
constexpr double kMaxDifference = 1.5 * 1.4826;  ///< sigmas (of the median) of the windows'

/// Keypoints by the rows that they may be matched on.
class RowBands {
 public:
  RowBands(const std::vector<Keypoint>& keypoints, int height, const OrbExtractor& extractor)
      : begin_(static_cast<std::size_t>(height) + 1, 0) {
    const auto each_row = [&](auto&& visit) {
      for (std::size_t i = 0; i < keypoints.size(); ++i) {
        const double reach = kRowTolerance * extractor.scale_of(keypoints[i].level);
        const int first = std::max(0, static_cast<int>(std::ceil(keypoints[i].y - reach)));
        const int last = std::min(height - 1, static_cast<int>(std::floor(keypoints[i].y + reach)));
        for (int row = first; row <= last; ++row) visit(static_cast<std::size_t>(row), i);
      }
    };
    each_row([&](std::size_t row, std::size_t) { ++begin_[row + 1]; });
    for (std::size_t row = 1; row < begin_.size(); ++row) begin_[row] += begin_[row - 1];
    items_.resize(begin_.back());
    std::vector<std::size_t> next = begin_;
    each_row([&](std::size_t row, std::size_t i) { items_[next[row]++] = i; });
  }

  /// Calls visit(index) for the keypoints of the row nearest to y.
  template <class Visit>
  void at(float y, Visit&& visit) const {
    const long row = std::lround(y);
    if (row < 0 || row + 1 >= static_cast<long>(begin_.size())) return;
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t k = begin_[r]; k < begin_[r + 1]; ++k) visit(items_[k]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> items_;
};

class StereoMatching {
 public:
  StereoMatching(const Extraction& left, const Extraction& right, const PinholeCamera& camera,
                 double baseline, const OrbExtractor& extractor, const StereoConfig& config)
      : left_(left),
        right_(right),
        extractor_(extractor),
        config_(config),
        focal_baseline_(camera.fx * baseline),
        max_depth_(config.max_depth_baselines * baseline),
        max_disparity_(focal_baseline_ / kMinDepth) {}

  std::vector<StereoMatch> run() {
    const std::size_t count = left_.features.size();
    const RowBands bands(right_.features.keypoints, right_.pyramid.front().rows, extractor_);
    std::vector<StereoMatch> matches(count);
    differences_.assign(count, -1);
    for (std::size_t i = 0; i < count; ++i) {
      const int candidate = best_candidate(i, bands);
      if (candidate >= 0) matches[i] = refine(i, static_cast<std::size_t>(candidate));
    }
    remove_outliers(matches);
    return matches;
  }

 private:
  /// Index of the right keypoint with the nearest descriptor; -1 without one.
  int best_candidate(std::size_t i, const RowBands& bands) const {
    const Keypoint& seen = left_.features.keypoints[i];
    int best = -1;
    int least = config_.max_hamming + 1;
    bands.at(seen.y, [&](std::size_t j) {
      const Keypoint& other = right_.features.keypoints[j];
      if (std::abs(other.level - seen.level) > 1) return;
      // A keypoint at infinity may lie a little on the wrong side before refinement.
      const double disparity = static_cast<double>(seen.x) - static_cast<double>(other.x);
      if (disparity < -extractor_.scale_of(seen.level) || disparity > max_disparity_) return;
      const int distance =
          hamming_distance(left_.features.descriptors[i], right_.features.descriptors[j]);
      if (distance >= least) return;
      least = distance;
      best = static_cast<int>(j);
    });
    return best;
  }

  /// Sub-pixel disparity on the pyramid level of the left keypoint.
  StereoMatch refine(std::size_t i, std::size_t j) {
    const Keypoint& seen = left_.features.keypoints[i];
    const Keypoint& other = right_.features.keypoints[j];
    const auto level = static_cast<std::size_t>(seen.level);
    const double scale = extractor_.scale_of(seen.level);
    const auto on_level = [scale](float v) {
      return static_cast<int>(std::lround((static_cast<double>(v) + 0.5) / scale - 0.5));
    };
    const double guess = (static_cast<double>(seen.x) - static_cast<double>(other.x)) / scale;
    const std::optional<PatchAlignment> aligned = align_patch(
        left_.pyramid[level], right_.pyramid[level], on_level(seen.x), on_level(seen.y), guess);
    if (!aligned) return {};
    const double disparity = aligned->shift * scale;
    if (disparity <= 0 || disparity > max_disparity_) return {};
    differences_[i] = aligned->difference;
    const double depth = focal_baseline_ / disparity;
    return {static_cast<float>(static_cast<double>(seen.x) - disparity),
            depth < max_depth_ ? static_cast<float>(depth) : -1.0F};
  }

  /// Drops matches whose windows differ far more than most do.
  void remove_outliers(std::vector<StereoMatch>& matches) const {
    std::vector<double> sorted;
    for (const double difference : differences_) {
      if (difference >= 0) sorted.push_back(difference);
    }
    if (sorted.empty()) return;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double limit = kMaxDifference * *middle;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (differences_[i] > limit) matches[i] = {};
    }
  }

  const Extraction& left_;
  const Extraction& right_;
  const OrbExtractor& extractor_;
  const StereoConfig& config_;
  double focal_baseline_;
  double max_depth_;
  double max_disparity_;
  std::vector<double> differences_;  ///< grey levels; -1 without a match
};

}  // namespace

std::vector<StereoMatch> match_stereo(const Extraction& left, const Extraction& right,
                                      const PinholeCamera& camera, double baseline,
                                      const OrbExtractor& extractor, const StereoConfig& config) {
  if (!(baseline > 0)) fail("stereo matching: expected a baseline above 0 m, found {}", baseline);
  if (left.pyramid.empty() || right.pyramid.empty() ||
      left.pyramid.front().size() != right.pyramid.front().size()) {
    fail("stereo matching: expected two pictures of the same size");
  }
  return StereoMatching(left, right, camera, baseline, extractor, config).run();
}

}  // namespace vinebench
