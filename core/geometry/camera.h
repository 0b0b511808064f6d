// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace vinebench {

/// How a lens bends what a pinhole would see.
enum class LensModel {
  kRadialTangential,  ///< Brown and Conrady: k1, k2, p1, p2, k3, in OpenCV's order
  kEquidistant,       ///< Kannala and Brandt (2006), for fisheyes: k1, k2, k3, k4, as OpenCV's
                      ///< fisheye model and Kalibr's "equidistant"
  kDoubleSphere,      ///< Usenko, Demmel and Cremers (2018), for fisheyes: xi, alpha
};

/// "radial_tangential", "equidistant", "double_sphere".
std::vector<std::string> yaml_names(LensModel);

/// Whether a lens model may be given by so many coefficients: k3 of the first may be absent, for 0.
bool has_coefficients(LensModel model, std::size_t count);
/// "expected k1, k2, k3, k4".
std::string expected_coefficients(LensModel model);

/// Camera of a single centre: a pinhole with a lens.
///
/// Camera frame: x right, y down, z into the scene (optical). Pixel (0, 0) is the centre of the top
/// left pixel, so the image covers [-0.5, width - 0.5) x [-0.5, height - 0.5).
struct PinholeCamera {
  /// Tangent of the largest angle from the axis, 89.5 degrees, that has a place on the plane z = 1.
  static constexpr double kWidest = 114.59;

  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  double fx = 0;   ///< pixels
  double fy = 0;
  double cx = 0;
  double cy = 0;
  std::array<double, 5> distortion{};  ///< coefficients of the lens model; 0 behind them
  LensModel lens = LensModel::kRadialTangential;

  /// Sets the lens. Requires has_coefficients().
  void set_lens(LensModel model, const std::vector<double>& coefficients);
  /// The coefficients, without a k3 of 0.
  std::vector<double> coefficients() const;

  /// Whether it is more than a pinhole.
  bool has_distortion() const;
  /// The pinhole with the same size, principal point and, near it, magnification.
  PinholeCamera without_distortion() const;

  /// Pixel of a point in the camera frame. Requires z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p_cam) const;

  /// Point of the plane z = 1 that is seen at `pixel`; of a fisheye that sees farther aside than
  /// kWidest, the point of that angle. Inverts the distortion to 1e-10 for lenses whose distortion
  /// is monotonic in the image.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const;

  /// Whether the pixel is inside the image, at least `margin` pixels from its border.
  bool contains(const Eigen::Vector2d& pixel, double margin = 0) const {
    return pixel.x() >= margin - 0.5 && pixel.y() >= margin - 0.5 &&
           pixel.x() < width - 0.5 - margin && pixel.y() < height - 0.5 - margin;
  }
};

}  // namespace vinebench
