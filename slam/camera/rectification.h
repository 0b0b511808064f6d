// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/geometry/rig.h"
#include "slam/features/features.h"
#include "slam/features/orb_extractor.h"

namespace vinebench::slam {

/// Turns the images of two cameras that look roughly the same way into those of a rectified pair:
/// one lens without distortion, cameras on one row, at the same places as the real ones.
///
/// The common view after Fusiello, Trucco and Verri, "A compact algorithm for rectification of
/// stereo pairs" (2000): x along the baseline, z the mean of the two view axes, made orthogonal to
/// it. The focal length is the largest that leaves no pixel without a source, but at most the real
/// one; what is then without a source gives no features. Of a fisheye 55 degrees to either side are
/// used at most.
class Rectification {
 public:
  /// Throws Error that begins with `what` where the right camera is not to the right of the left
  /// one, where they look in different directions, and for a lens whose distortion turns back
  /// within the image, as far as it is used.
  Rectification(const RigCamera& left, const RigCamera& right, const std::string& what);

  const PinholeCamera& lens() const { return lens_; }
  const Pose& T_body_left() const { return T_body_left_; }
  double baseline() const { return baseline_; }  ///< m

  /// `grey` is CV_8UC1 of the real camera's size.
  cv::Mat left(const cv::Mat& grey) const { return cameras_[0].remapped(grey); }
  cv::Mat right(const cv::Mat& grey) const { return cameras_[1].remapped(grey); }

  /// Where in the left camera's image a pixel of its rectified one is.
  Eigen::Vector2d in_left_image(const Eigen::Vector2d& pixel) const;

  /// Takes away the left image's features whose neighbourhood has pixels without a source.
  void drop_unseen(Features& features, const OrbExtractor& extractor) const;

 private:
  /// Where in the real image each pixel of the rectified one is.
  struct Camera {
    PinholeCamera model;
    Eigen::Matrix3d R_cam_common;
    cv::Mat whole, fraction;  ///< cv::remap's fixed-point maps
    cv::Mat remapped(const cv::Mat& grey) const;
  };
  void choose_view(const RigCamera& left, const RigCamera& right, const std::string& what);
  void choose_lens(const std::string& what);
  cv::Mat fill_maps(Camera& camera) const;

  std::array<Camera, 2> cameras_;
  PinholeCamera lens_;
  Pose T_body_left_;
  double baseline_ = 0;
  cv::Mat clearance_;  ///< px from each left pixel to the nearest without a source; empty: all have
};

}  // namespace vinebench::slam
