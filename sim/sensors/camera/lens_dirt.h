// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/config/config_field.h"
#include "sim/sensors/fault_scope.h"

namespace vinebench::sim {

/// Specks of dust and mud on the front glass, far out of focus; where they are is drawn by seed and
/// camera.
struct LensDirtConfig {
  FaultScope scope;
  int count = 40;
  std::array<double, 2> radius_px{8, 45};  ///< least and greatest, px; small ones are many
  double opacity = 0.8;                    ///< greatest share of the light that a speck takes
  double blur_px = 7;                      ///< standard deviation of its edge, px
  double glow = 0.35;        ///< light that a speck scatters into the lens, of the image's mean
  std::int64_t pattern = 0;  ///< another number, another pattern
  template <class Archive>
  void serialize(Archive& archive) {
    scope.serialize(archive);
    archive("count", count, Range::between(0, 10000));
    archive("radius_px", radius_px, Range::between(0.5, 2000));
    archive("opacity", opacity, Range::between(0, 1));
    archive("blur_px", blur_px, Range::between(0, 200));
    archive("glow", glow, Range::between(0, 1));
    archive("pattern", pattern, Range::non_negative());
    archive.require(radius_px[0] <= radius_px[1], "radius_px", "expected the lesser one first");
  }
};

/// A vine leaf that sticks to the front glass.
struct LensLeafConfig {
  FaultScope scope;
  Eigen::Vector2d position{0.5, 0.5};  ///< of its middle, shares of the image's width and height
  double size = 0.5;                   ///< its length, share of the image's height
  double angle_deg = 0;                ///< its tip points up at 0, to the right at 90
  double opacity = 1;                  ///< share of the light that it takes
  double blur_px = 6;                  ///< standard deviation of its edge, px
  template <class Archive>
  void serialize(Archive& archive) {
    scope.serialize(archive);
    archive("position", position, Range::between(-1, 2));
    archive("size", size, Range::between(0.01, 10));
    archive("angle_deg", angle_deg, Range::between(-360, 360));
    archive("opacity", opacity, Range::between(0, 1));
    archive("blur_px", blur_px, Range::between(0, 200));
  }
};

/// Something on the glass: it takes light and shines with a colour of its own, lit by the scene.
struct LensCover {
  FaultScope scope;
  cv::Mat opacity;          ///< CV_32FC1, 0 to 1
  cv::Vec3f glow{0, 0, 0};  ///< linear colour where it is opaque, of the image's mean light

  /// Onto linear light (CV_32FC3), in place.
  void apply(cv::Mat& light) const;
};

LensCover make_lens_dirt(const LensDirtConfig& config, cv::Size size, std::uint64_t seed,
                         int camera);
LensCover make_lens_leaf(const LensLeafConfig& config, cv::Size size);

}  // namespace vinebench::sim
