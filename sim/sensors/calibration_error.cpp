// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/calibration_error.h"

#include "core/geometry/angle.h"
#include "core/util/error.h"
#include "core/util/random.h"

namespace vinebench::sim {
namespace {

Eigen::Vector3d draw(const RandomStream& stream, std::uint64_t first) {
  return {stream.normal(first), stream.normal(first + 1), stream.normal(first + 2)};
}

CalibrationErrorConfig::Camera drawn_error(const CalibrationErrorConfig& config, std::size_t camera,
                                           std::uint64_t seed) {
  const RandomStream stream(seed, "calibration." + std::to_string(camera));
  CalibrationErrorConfig::Camera error;
  error.position = config.position * draw(stream, 0);
  error.rotation_deg = config.rotation_deg * draw(stream, 3);
  error.focal_px.setConstant(config.focal_px * stream.normal(6));
  error.principal_point_px = config.principal_point_px * draw(stream, 7).head<2>();
  return error;
}

void apply(const CalibrationErrorConfig::Camera& error, RigCamera& camera) {
  PinholeCamera& model = camera.model;
  model.fx += error.focal_px.x();
  model.fy += error.focal_px.y();
  if (!(model.fx > 0 && model.fy > 0)) {
    fail("calibration error: camera '{}': focal lengths of {} and {} px, expected above 0",
         camera.name, model.fx, model.fy);
  }
  model.cx += error.principal_point_px.x();
  model.cy += error.principal_point_px.y();
  for (std::size_t i = 0; i < 4; ++i) model.distortion[i] += error.distortion[i];
  if (error.position.isZero(0) && error.rotation_deg.isZero(0)) return;
  camera.T_body_cam =
      camera.T_body_cam * Pose{exp_so3(kRadiansPerDegree * error.rotation_deg), error.position};
}

}  // namespace

Rig true_rig(const Rig& told, const CalibrationErrorConfig& config, std::uint64_t seed) {
  Rig rig = told;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    apply(drawn_error(config, i, seed), rig.cameras[i]);
  }
  for (const CalibrationErrorConfig::Camera& error : config.cameras) {
    const int camera = rig.find_camera(error.name);
    if (camera < 0) {
      fail("calibration error: rig '{}' has no camera named '{}'", rig.name, error.name);
    }
    apply(error, rig.cameras[static_cast<std::size_t>(camera)]);
  }
  return rig;
}

}  // namespace vinebench::sim
