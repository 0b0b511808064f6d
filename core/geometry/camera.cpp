// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/camera.h"

namespace vinebench {
namespace {

/// Brown-Conrady: the distorted position of the ideal point (x, y) of the plane z = 1.
Eigen::Vector2d distort(const Eigen::Vector2d& p, const std::array<double, 4>& d) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (d[0] + r2 * d[1]);
  return {x * radial + 2.0 * d[2] * x * y + d[3] * (r2 + 2.0 * x * x),
          y * radial + d[2] * (r2 + 2.0 * y * y) + 2.0 * d[3] * x * y};
}

}  // namespace

bool PinholeCamera::has_distortion() const {
  return distortion != std::array<double, 4>{};
}

Eigen::Vector2d PinholeCamera::project(const Eigen::Vector3d& p_cam) const {
  Eigen::Vector2d p = p_cam.head<2>() / p_cam.z();
  if (has_distortion()) p = distort(p, distortion);
  return {fx * p.x() + cx, fy * p.y() + cy};
}

Eigen::Vector3d PinholeCamera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  Eigen::Vector2d ideal = seen;
  if (has_distortion()) {
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d error = seen - distort(ideal, distortion);
      ideal += error;
      if (error.squaredNorm() < 1e-24) break;
    }
  }
  return {ideal.x(), ideal.y(), 1.0};
}

}  // namespace vinebench
