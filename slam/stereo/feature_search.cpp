// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/feature_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace vinebench::slam {
namespace {

constexpr double kRowTolerance = 2;   // px of the level
constexpr int kMaxBits = 64;          // in which the descriptors differ
constexpr double kSecondBest = 0.85;  // as TrackingConfig::second_best

}  // namespace

FeatureSearch::FeatureSearch(const Features& right, int rows, const OrbExtractor& extractor)
    : right_(right), extractor_(extractor), on_row_(static_cast<std::size_t>(std::max(1, rows))) {
  for (std::size_t i = 0; i < right.size(); ++i) {
    const auto row = std::clamp<long>(std::lround(right.keypoints[i].y), 0,
                                      static_cast<long>(on_row_.size()) - 1);
    on_row_[static_cast<std::size_t>(row)].push_back(i);
  }
}

std::optional<double> FeatureSearch::disparity_of(const Keypoint& left,
                                                  const Descriptor& descriptor,
                                                  double max_disparity) const {
  const double reach = kRowTolerance * extractor_.scale_of(left.level);
  const double last = static_cast<double>(on_row_.size()) - 1;
  const auto from = static_cast<std::size_t>(std::clamp(std::ceil(left.y - reach), 0.0, last));
  const auto to = static_cast<std::size_t>(std::clamp(std::floor(left.y + reach), 0.0, last));
  int best = kMaxBits + 1;
  int second = 257;
  double disparity = 0;
  for (std::size_t row = from; row <= to; ++row) {
    for (const std::size_t i : on_row_[row]) {
      const Keypoint& seen = right_.keypoints[i];
      const double shift = static_cast<double>(left.x) - static_cast<double>(seen.x);
      if (std::abs(seen.level - left.level) > 1 || shift <= 0 || shift > max_disparity) continue;
      const int bits = hamming_distance(descriptor, right_.descriptors[i]);
      if (bits < best) {
        second = std::exchange(best, bits);
        disparity = shift;
      } else {
        second = std::min(second, bits);
      }
    }
  }
  if (best > kMaxBits || best >= kSecondBest * second) return std::nullopt;
  return disparity;
}

}  // namespace vinebench::slam
