// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "slam/features/orb_extractor.h"
#include "slam/stereo/stereo_matcher.h"

namespace vinebench::slam {

/// How much brighter one eye of a stereo pair sees the same thing than the other: cameras that
/// expose by themselves, apertures set by hand. The window search compares grey levels, so that the
/// right image is made as bright as the left one first. Images of cameras that agree are left as
/// they are.
///
/// The gain is measured where both eyes are known to see the same, in the windows of the last
/// frame's matches. Where there are too few for that, it is guessed from the two images' grey
/// levels and believed only if it makes many more windows match: one eye may be covered further
/// than the other.
class EyeBalance {
 public:
  /// Left over right; 1 where they agree within 5 %.
  double gain() const { return gain_; }

  /// The right image (CV_8UC1) as bright as the left eye would see it; itself where the eyes agree.
  static cv::Mat balanced(const cv::Mat& right, double gain);

  /// A gain that would explain why few of the left features were found in the right image, as taken
  /// (both CV_8UC1, unbalanced); none where enough were, or the images are as bright as the gain
  /// says.
  std::optional<double> suspect(const cv::Mat& left, const cv::Mat& right,
                                const std::vector<StereoMatch>& matches) const;

  /// Takes over a suspected gain that was tried. Returns whether the matches bear it out.
  bool believe(double gain, const std::vector<StereoMatch>& without,
               const std::vector<StereoMatch>& with);

  /// Measures the gain anew: medians of windows of the left pyramid against those of the right one
  /// that was balanced by gain(). Saturated windows say nothing.
  void measure(const Extraction& left, const std::vector<cv::Mat>& right,
               const std::vector<StereoMatch>& matches, const OrbExtractor& extractor);

 private:
  double gain_ = 1;
};

}  // namespace vinebench::slam
