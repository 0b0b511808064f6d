// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/image_times.h"

#include "slam/factors/calibration_belief.h"

namespace vinebench::slam {

ErrorOfImageTimes error_of_image_times(const FrameFeatures& frame, const Associations& associations,
                                       const EstimatorRig& rig) {
  ErrorOfImageTimes error;
  error.by_calibration.setZero(6, to_vector(rig.calibration).size());
  double count = 0;
  double late = 0;  // sum, s
  for (std::size_t v = 0; v < associations.size(); ++v) {
    const StereoCameraModel& camera = rig.left_cameras[v];
    const auto of_view = static_cast<Eigen::Index>(v) * kPairUnknowns;
    auto by_time = error.by_calibration.col(of_view + PairNumber::kTime);
    auto by_readout = error.by_calibration.col(of_view + PairNumber::kReadout);
    for (std::size_t i = 0; i < associations[v].size(); ++i) {
      if (associations[v][i] < 0) continue;
      const double y = frame.views[v].features.keypoints[i].y;
      by_time -= frame.velocity;
      by_readout -= frame.velocity * camera.share_of_readout(y);
      late += frame.views[v].late + camera.time_of(y);
      ++count;
    }
  }
  if (count == 0) return error;
  error.by_calibration /= count;
  const Vector6d way = late / count * error_of_velocity();
  error.by_velocity = way.cwiseAbs2().asDiagonal();
  return error;
}

}  // namespace vinebench::slam
