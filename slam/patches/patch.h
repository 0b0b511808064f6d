// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace vinebench::slam {

/// Grey levels around a feature, on its own pyramid level: what the landmark looks like.
struct Patch {
  /// More than the window that is compared, so that it can be seen from nearer, farther and aslant.
  static constexpr int kRadius = 8;
  static constexpr int kSide = 2 * kRadius + 1;
  std::array<std::uint8_t, kSide * kSide> grey{};
};

/// Cuts the patch about (x, y) px out of a CV_8UC1 image; none where it leaves the image.
std::optional<Patch> cut_patch(const cv::Mat& image, double x, double y);

/// What another image is compared with: a 9 x 9 px window of it as the patch says that it looks.
struct PatchWindow {
  static constexpr int kRadius = 4;
  static constexpr int kSide = 2 * kRadius + 1;
  static constexpr int kArea = kSide * kSide;
  std::array<float, kArea> grey;        ///< mean removed
  std::array<float, kArea> gradient_x;  ///< grey levels a px, mean removed
  std::array<float, kArea> gradient_y;
  Eigen::Matrix2f normal;  ///< sum of products of the gradients
  float contrast = 0;      ///< grey levels, mean absolute deviation
};

/// The window that a homography (patch pixels, the patch's centre at (0, 0), to image pixels)
/// makes of the patch, about where its centre comes to lie. None where the window shows more than
/// the patch.
std::optional<PatchWindow> warp_patch(const Patch& patch, const Eigen::Matrix3d& H_image_patch);

/// Where a patch was found.
struct PatchFit {
  double x = 0;  ///< px
  double y = 0;
  double difference = 0;  ///< grey levels, mean absolute difference there, brightness aside
  double contrast = 0;    ///< grey levels, mean absolute deviation of the window
};

/// Finds the window near (x, y) of a CV_8UC1 image: shift and brightness by Gauss-Newton steps
/// with the window's own gradients (inverse compositional: Baker and Matthews, "Lucas-Kanade 20
/// years on", 2004). None where it has too little texture to be placed, leaves the image or runs
/// away by more than two pixels.
std::optional<PatchFit> fit_patch(const PatchWindow& window, const cv::Mat& image, double x,
                                  double y);

}  // namespace vinebench::slam
