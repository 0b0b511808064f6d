// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/camera.h"
#include "slam/features/orb_extractor.h"
#include "slam/patches/patch_alignment.h"

namespace vinebench::slam {

/// How a feature's place in the right image is found.
enum class StereoSearch {
  kWindows,   ///< where the image looks alike, aligned to a fraction of a pixel
  kFeatures,  ///< the most alike of the right image's own features, as in the paper
};
inline std::vector<std::string> yaml_names(StereoSearch) {
  return {"windows", "features"};
}

struct StereoConfig {
  StereoSearch search = StereoSearch::kWindows;  ///< in the right image itself, or its features
  double max_depth_baselines = 40;  ///< farther depths are no measurements (paper, Sect. III-A)
  /// Features up to here begin landmarks too: those say little of the way but much of the heading,
  /// and for longest.
  double far_depth_baselines = 150;
  /// Where fewer are within max_depth_baselines, those beyond measure their depth too: nothing else
  /// tells how far the body moves. Elsewhere not, as the calibration's error is common to them.
  int few_near = 100;
  int few = 200;             ///< where fewer agree, dirt on a lens may be why
  double min_depth = 0.15;   ///< m; nothing is nearer
  double uniqueness = 1.15;  ///< the next best place must differ by this factor more
  /// Mean difference of the aligned windows, as a share of their contrast, that is still a match.
  /// Windows that show two depths, a stem before the ground, differ more: they would be biased
  /// towards the nearer one.
  double max_residual = 0.1;
  /// Likewise where dirt on a lens has taken contrast from nearly every window.
  double dirty_residual = 0.4;
  bool self_calibration = true;  ///< corrects the pairs' calibrations where the map shows them off
  double calibration_sigma = 1;  ///< px, accuracy of the disparities as the rig file has them
  double noise = 1.5;            ///< grey levels, difference that the sensor's noise alone explains

  /// Whether aligned windows show the same thing.
  bool accepts(const PatchAlignment& aligned) const {
    return aligned.difference <= noise + max_residual * aligned.contrast;
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("search", search);
    archive("max_depth_baselines", max_depth_baselines, Range::positive());
    archive("few", few, Range::non_negative());
    archive("few_near", few_near, Range::non_negative());
    archive("far_depth_baselines", far_depth_baselines, Range::positive());
    archive("min_depth", min_depth, Range::positive());
    archive("uniqueness", uniqueness, Range::between(1, 10));
    archive("max_residual", max_residual, Range::between(0.01, 2));
    archive("dirty_residual", dirty_residual, Range::between(0.01, 2));
    archive("self_calibration", self_calibration);
    archive("calibration_sigma", calibration_sigma, Range::positive());
    archive("noise", noise, Range::between(0, 50));
  }
};

/// For each keypoint of the left image.
struct StereoMatch {
  float x_right = -1;  ///< px in the right image, sub-pixel; -1 without a match
  float depth = -1;    ///< m along the optical axis; -1 without a match or beyond the limit
  /// How the surface is slanted: change of the inverse depth along x and y, as a share of it a px.
  float slant_x = 0;
  float slant_y = 0;
};

/// How many features were found in the right image, however far away.
std::size_t count_found(const std::vector<StereoMatch>& matches);

/// How many of them have a depth.
int count_with_depth(const std::vector<StereoMatch>& matches);

/// Finds the left image's keypoints in the right one of a rectified pair (same lens, same rows):
/// search of the window about each along the epipolar line on its pyramid level, accepted where the
/// place is unique and the search back from there finds the keypoint again; then sub-pixel
/// alignment. With StereoSearch::kFeatures by FeatureSearch; only then the right image's features
/// are read.
///
/// The window search reads the right image itself, not features extracted there: a plant's corners
/// are often found in one camera only, and two thirds of the left ones would stay without a
/// partner.
std::vector<StereoMatch> match_stereo(const Extraction& left, const Extraction& right,
                                      const PinholeCamera& camera, double baseline,
                                      const OrbExtractor& extractor, const StereoConfig& config);

/// Whether dirt on a lens explains that few windows agree within StereoConfig::max_residual
/// (`matches`), where those within the dirty_residual are that many more (`looser`).
bool is_dirty(const std::vector<StereoMatch>& matches, const std::vector<StereoMatch>& looser,
              const StereoConfig& config);

}  // namespace vinebench::slam
