// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace vinebench::slam {

/// An image corner with its scale and direction.
struct Keypoint {
  float x = 0;  ///< px of the full-size image
  float y = 0;
  float angle = 0;     ///< rad, direction of the intensity centroid, image axes (y down)
  float response = 0;  ///< corner strength
  int level = 0;       ///< of the scale pyramid; 0 is the full-size image
};

/// 256 bits of rotated BRIEF.
using Descriptor = std::array<std::uint64_t, 4>;

/// Number of bits in which two descriptors differ, 0 to 256.
inline int hamming_distance(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) distance += std::popcount(a[i] ^ b[i]);
  return distance;
}

/// Pixels of level 0 to those of a level whose pixel is `pixel` of them large, and back: the
/// corners of the images coincide, not the centres of their first pixels.
inline double to_level(double v, double pixel) {
  return (v + 0.5) / pixel - 0.5;
}
inline double from_level(double v, double pixel) {
  return (v + 0.5) * pixel - 0.5;
}

/// What was extracted from one image; keypoint i has descriptor i.
struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  std::size_t size() const { return keypoints.size(); }
};

}  // namespace vinebench::slam
