// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/geometry/camera.h"
#include "slam/features/orb_extractor.h"
#include "slam/stereo/stereo_matcher.h"

namespace vinebench::slam {

/// How far the rows of a pair's eyes agree that are left as they are: px.
struct RowTolerance {
  double middle = 0;      ///< of the image
  double everywhere = 0;  ///< root mean square over the image
};

/// By how much one eye of a stereo pair has things on other rows than the other (its vertical
/// disparity), where the rig file says that it has them on the same ones: mountings move, principal
/// points are known to a pixel. The window search looks along rows, so that the right image is put
/// straight first. Images of eyes that agree are left as they are.
///
/// The right eye is taken to be higher or farther ahead than said, turned about any axis a little,
/// and of another focal length, each by what it does to the rows. Columns stay as they are: on real
/// drives what the rows say is not true of them. Measured is where both eyes are known to see the
/// same, in the windows of each frame's matches, over the last seconds. Where the rows are so wrong
/// that next to nothing matches, a shift is searched for.
class EyeAlignment {
 public:
  /// Stereo matches of a left extraction in a right one.
  using Search = std::function<std::vector<StereoMatch>(const Extraction&, const Extraction&)>;

  /// Eyes whose rows agree as far as `tolerance` are left alone.
  EyeAlignment(const PinholeCamera& lens, const RowTolerance& tolerance);

  /// By how many px the right eye has what is mostly seen there lower than said, at a pixel; 0
  /// where the eyes agree.
  double correction(double x, double y) const;

  /// The right image (CV_8UC1) as the eye would see it straight; itself where the eyes agree.
  cv::Mat aligned(const cv::Mat& right) const;

  /// Searches for a shift that explains why so few of the left features were found in the right
  /// image (its pyramid as it was searched), and takes it over where it makes many more match.
  /// Returns whether it does.
  bool search_shift(const Extraction& left, const std::vector<cv::Mat>& right,
                    const std::vector<StereoMatch>& matches, const Search& search);

  /// Measures anew, with a right pyramid that was aligned().
  void measure(const Extraction& left, const std::vector<cv::Mat>& right,
               const std::vector<StereoMatch>& matches, const OrbExtractor& extractor);

 private:
  /// On which other row a window was found.
  struct WindowRow {
    double x, y;       ///< px, in the left image
    double disparity;  ///< px
    double shift;      ///< px, row in the right image less that in the left one
    double variance;   ///< px^2
  };

  static constexpr int kUnknowns = 6;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

  Eigen::RowVector<double, kUnknowns> row_of(double x, double y, double disparity) const;
  void forget();
  void add(const std::vector<WindowRow>& windows);
  void use(const Unknowns& known);
  void fill_maps();

  PinholeCamera lens_;
  RowTolerance tolerance_;
  Unknowns used_ = Unknowns::Zero();  ///< that the maps are of; all zero where the eyes agree
  cv::Mat whole_, fraction_;          ///< cv::remap's fixed-point maps
  /// Of shift and keystone (px), turn (rad), focal length (share), height and place ahead
  /// (baselines).
  Eigen::Matrix<double, kUnknowns, kUnknowns> information_;
  Unknowns information_vector_ = Unknowns::Zero();
  double disparity_ = 0;       ///< px, of what is mostly seen
  double disparity_used_ = 0;  ///< px, likewise, that the maps are of
  int frames_to_wait_ = 0;     ///< before a shift is searched for again
};

}  // namespace vinebench::slam
