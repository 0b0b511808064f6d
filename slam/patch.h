// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace vinebench {

/// Grey levels around a feature, on its own pyramid level: what the landmark looks like.
struct Patch {
  static constexpr int kRadius = 5;
  static constexpr int kSide = 2 * kRadius + 1;
  std::array<std::uint8_t, kSide * kSide> grey{};
};

/// Cuts the patch about (x, y) px out of a CV_8UC1 picture; none where it leaves the picture.
std::optional<Patch> cut_patch(const cv::Mat& picture, double x, double y);

/// Where a patch was found.
struct PatchFit {
  double x = 0;  ///< px
  double y = 0;
  double difference = 0;  ///< grey levels, mean absolute difference there, brightness aside
  double contrast = 0;    ///< grey levels, mean absolute deviation of the patch
};

/// How a patch's surroundings appear in another picture: where its inner pixels come to lie against
/// its centre (px there, row by row), and the mean Jacobian of that map.
struct PatchWarp {
  static constexpr int kRadius = Patch::kRadius - 1;
  static constexpr int kSide = 2 * kRadius + 1;
  std::array<Eigen::Vector2f, kSide * kSide> offset;
  Eigen::Matrix2f jacobian;
};

/// The warp of a homography (patch pixels, its centre at (0, 0), to picture pixels).
PatchWarp make_warp(const Eigen::Matrix3d& H_picture_patch);

/// Finds the patch near (x, y) of another CV_8UC1 picture, warped as told: shift and brightness by
/// Gauss-Newton steps with the patch's own gradients (inverse compositional: Baker and Matthews,
/// "Lucas-Kanade 20 years on", 2004). None where it has too little texture to be placed, leaves the
/// picture or runs away by more than two pixels.
std::optional<PatchFit> fit_patch(const Patch& patch, const PatchWarp& warp, const cv::Mat& picture,
                                  double x, double y);

}  // namespace vinebench
