// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/rig_calibration.h"
#include "slam/camera/measurement_noise.h"
#include "slam/camera/stereo_camera.h"
#include "slam/camera/stereo_rig.h"
#include "slam/camera/tag_cameras.h"
#include "slam/features/orb_extractor.h"
#include "slam/odometry/wheel_odometry.h"
#include "slam/patches/refinement_config.h"

namespace vinebench::slam {

/// What the estimator knows of its cameras and their noise: a value that is derived once and handed
/// to whoever needs it. Self-calibration makes another one; work that runs beside tracking keeps
/// the one it was given.
struct EstimatorRig {
  EstimatorRig(const StereoRig& stereo_rig, const OrbConfig& features,
               const RefinementConfig& refinement = {});

  /// The same rig with what self-calibration has found, of each pair and camera for tags, in place
  /// of what it found before.
  EstimatorRig with_calibration(const RigCalibration& found) const;

  /// Index among the cameras in use for tags of one of them.
  std::size_t tag_camera(int camera) const;

  /// s that the images of a camera in use for tags are taken later than they are stamped, as far as
  /// is known.
  double tag_time(int camera) const { return calibration.tag_times[tag_camera(camera)]; }

  StereoRig rig;                                   ///< as its file has it
  std::vector<StereoCameraModel> nominal_cameras;  ///< left camera of each pair, as the file has it
  RigCalibration calibration;                      ///< what self-calibration has found
  std::vector<StereoCameraModel> left_cameras;     ///< with that
  std::vector<Pose> T_body_cams;                   ///< of these
  TagCameras tag_cameras;
  MeasurementNoise noise;
  std::optional<MecanumWheels> wheels;  ///< where there are any
};

}  // namespace vinebench::slam
