// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/estimator_rig.h"

#include <algorithm>
#include <cmath>

namespace vinebench::slam {

EstimatorRig::EstimatorRig(const StereoRig& stereo_rig, const OrbConfig& features,
                           const RefinementConfig& refinement)
    : rig(stereo_rig), tag_cameras(stereo_rig.cameras) {
  for (const RectifiedPair& pair : rig.pairs) {
    nominal_cameras.push_back({pair.lens, pair.T_cam_body, pair.baseline});
    T_body_cams.push_back(pair.T_body_cam);
  }
  left_cameras = nominal_cameras;
  calibration.pairs.resize(rig.pairs.size());
  calibration.tag_times.resize(rig.tag_cameras.size());
  for (int level = 0; level < features.levels; ++level) {
    noise.level_scales.push_back(std::pow(features.scale, level));
  }
  noise.placed_sigma = refinement.sigma;
  noise.placed_disparity_sigma = refinement.disparity_sigma;
  noise.placed_tolerance = refinement.tolerance;
}

EstimatorRig EstimatorRig::with_calibration(const RigCalibration& found) const {
  const std::vector<PairCalibration>& pairs = found.pairs;
  EstimatorRig corrected = *this;
  corrected.calibration = found;
  corrected.calibration.tag_times.resize(rig.tag_cameras.size());
  for (std::size_t v = 0; v < pairs.size(); ++v) {
    corrected.left_cameras[v] = calibrated(nominal_cameras[v], pairs[v]);
    corrected.T_body_cams[v] = rig.pairs[v].T_body_cam * pairs[v].T_nominal_camera;
  }
  return corrected;
}

std::size_t EstimatorRig::tag_camera(int camera) const {
  const auto found = std::ranges::find(rig.tag_cameras, camera);
  return static_cast<std::size_t>(found - rig.tag_cameras.begin());
}

}  // namespace vinebench::slam
