// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace vinebench {

/// Pinhole camera with radial-tangential (Brown-Conrady) distortion k1, k2, p1, p2.
///
/// Camera frame: x right, y down, z into the scene (optical). Pixel (0, 0) is the centre of the top
/// left pixel, so the image covers [-0.5, width - 0.5) x [-0.5, height - 0.5).
struct PinholeCamera {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  double fx = 0;   ///< pixels
  double fy = 0;
  double cx = 0;
  double cy = 0;
  std::array<double, 4> distortion{};  ///< k1, k2, p1, p2

  bool has_distortion() const;

  /// Pixel of a point in the camera frame. Requires z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p_cam) const;

  /// Point of the plane z = 1 that is seen at `pixel`. Inverts the distortion by fixed-point
  /// iteration to 1e-10 for lenses whose distortion is monotonic in the image.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const;

  /// Whether the pixel is inside the image, at least `margin` pixels from its border.
  bool contains(const Eigen::Vector2d& pixel, double margin = 0) const {
    return pixel.x() >= margin - 0.5 && pixel.y() >= margin - 0.5 &&
           pixel.x() < width - 0.5 - margin && pixel.y() < height - 0.5 - margin;
  }
};

}  // namespace vinebench
