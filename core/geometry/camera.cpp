// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/camera.h"

#include <algorithm>
#include <cmath>

namespace vinebench {
namespace {

using Coefficients = std::array<double, 5>;

/// Brown-Conrady: the distorted position of the ideal point (x, y) of the plane z = 1.
Eigen::Vector2d brown(const Eigen::Vector2d& p, const Coefficients& d) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  return {x * radial + 2.0 * d[2] * x * y + d[3] * (r2 + 2.0 * x * x),
          y * radial + d[2] * (r2 + 2.0 * y * y) + 2.0 * d[3] * x * y};
}

/// By fixed-point iteration.
Eigen::Vector2d without_brown(const Eigen::Vector2d& seen, const Coefficients& d) {
  Eigen::Vector2d ideal = seen;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d error = seen - brown(ideal, d);
    ideal += error;
    if (error.squaredNorm() < 1e-24) break;
  }
  return ideal;
}

/// Distance from the principal point, in focal lengths, of what is seen at an angle, rad.
double bent(double angle, const Coefficients& d) {
  const double a2 = angle * angle;
  return angle * (1 + a2 * (d[0] + a2 * (d[1] + a2 * (d[2] + a2 * d[3]))));
}

double bent_slope(double angle, const Coefficients& d) {
  const double a2 = angle * angle;
  return 1 + a2 * (3 * d[0] + a2 * (5 * d[1] + a2 * (7 * d[2] + a2 * 9 * d[3])));
}

Eigen::Vector2d equidistant(const Eigen::Vector2d& p, const Coefficients& d) {
  const double r = p.norm();
  if (r < 1e-12) return p;
  return p * (bent(std::atan(r), d) / r);
}

/// By Newton's method.
Eigen::Vector2d without_equidistant(const Eigen::Vector2d& seen, const Coefficients& d) {
  const double r = seen.norm();
  if (r < 1e-12) return seen;
  const double widest = std::atan(PinholeCamera::kWidest);
  double angle = std::min(r, widest);
  for (int i = 0; i < 50; ++i) {
    const double step = (bent(angle, d) - r) / bent_slope(angle, d);
    if (!std::isfinite(step)) break;
    const double next = std::clamp(angle - step, 0.0, widest);
    if (std::abs(next - angle) < 1e-14) break;
    angle = next;
  }
  return seen * (std::tan(angle) / r);
}

/// The projection of Usenko et al., for z = 1.
Eigen::Vector2d double_sphere(const Eigen::Vector2d& p, const Coefficients& d) {
  const double xi = d[0], alpha = d[1];
  const double r2 = p.squaredNorm();
  const double d1 = std::sqrt(r2 + 1);
  const double shifted = xi * d1 + 1;
  const double d2 = std::sqrt(r2 + shifted * shifted);
  return p / (alpha * d2 + (1 - alpha) * shifted);
}

/// Their closed form of its inverse.
Eigen::Vector2d without_double_sphere(const Eigen::Vector2d& seen, const Coefficients& d) {
  const double xi = d[0], alpha = d[1];
  const double r2 = seen.squaredNorm();
  const double inside = 1 - (2 * alpha - 1) * r2;
  const Eigen::Vector2d widest = seen * (PinholeCamera::kWidest / std::max(std::sqrt(r2), 1e-12));
  if (inside < 0) return widest;
  const double z = (1 - alpha * alpha * r2) / (alpha * std::sqrt(inside) + 1 - alpha);
  const double root = z * z + (1 - xi * xi) * r2;
  if (root < 0) return widest;
  const double scale = (z * xi + std::sqrt(root)) / (z * z + r2);
  const double ahead = scale * z - xi;
  const Eigen::Vector2d ideal = seen * (scale / ahead);
  return ahead > 0 && ideal.norm() < PinholeCamera::kWidest ? ideal : widest;
}

Eigen::Vector2d distorted(const Eigen::Vector2d& p, const PinholeCamera& camera) {
  switch (camera.lens) {
    case LensModel::kEquidistant:
      return equidistant(p, camera.distortion);
    case LensModel::kDoubleSphere:
      return double_sphere(p, camera.distortion);
    case LensModel::kRadialTangential:
      break;
  }
  return brown(p, camera.distortion);
}

Eigen::Vector2d undistorted(const Eigen::Vector2d& seen, const PinholeCamera& camera) {
  switch (camera.lens) {
    case LensModel::kEquidistant:
      return without_equidistant(seen, camera.distortion);
    case LensModel::kDoubleSphere:
      return without_double_sphere(seen, camera.distortion);
    case LensModel::kRadialTangential:
      break;
  }
  return without_brown(seen, camera.distortion);
}

}  // namespace

std::vector<std::string> yaml_names(LensModel) {
  return {"radial_tangential", "equidistant", "double_sphere"};
}

bool has_coefficients(LensModel model, std::size_t count) {
  if (model == LensModel::kDoubleSphere) return count == 2;
  return count == 4 || (count == 5 && model == LensModel::kRadialTangential);
}

std::string expected_coefficients(LensModel model) {
  switch (model) {
    case LensModel::kEquidistant:
      return "expected k1, k2, k3, k4";
    case LensModel::kDoubleSphere:
      return "expected xi, alpha";
    case LensModel::kRadialTangential:
      break;
  }
  return "expected k1, k2, p1, p2, or these and k3";
}

void PinholeCamera::set_lens(LensModel model, const std::vector<double>& coefficients) {
  lens = model;
  distortion = {};
  std::copy_n(coefficients.begin(), std::min(coefficients.size(), distortion.size()),
              distortion.begin());
}

std::vector<double> PinholeCamera::coefficients() const {
  std::size_t count = distortion.size();
  while (!has_coefficients(lens, count) || (count == 5 && distortion[4] == 0)) --count;
  return {distortion.begin(), distortion.begin() + static_cast<std::ptrdiff_t>(count)};
}

bool PinholeCamera::has_distortion() const {
  return lens != LensModel::kRadialTangential || distortion != Coefficients{};
}

PinholeCamera PinholeCamera::without_distortion() const {
  PinholeCamera pinhole = *this;
  pinhole.lens = LensModel::kRadialTangential;
  pinhole.distortion = {};
  if (lens == LensModel::kDoubleSphere) {
    // Near the axis its d1 is z, and the denominator of its projection (1 + xi) z.
    pinhole.fx /= 1 + distortion[0];
    pinhole.fy /= 1 + distortion[0];
  }
  return pinhole;
}

Eigen::Vector2d PinholeCamera::project(const Eigen::Vector3d& p_cam) const {
  Eigen::Vector2d p = p_cam.head<2>() / p_cam.z();
  if (has_distortion()) p = distorted(p, *this);
  return {fx * p.x() + cx, fy * p.y() + cy};
}

Eigen::Vector3d PinholeCamera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d seen((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  const Eigen::Vector2d ideal = has_distortion() ? undistorted(seen, *this) : seen;
  return {ideal.x(), ideal.y(), 1.0};
}

}  // namespace vinebench
