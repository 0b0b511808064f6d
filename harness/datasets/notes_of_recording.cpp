// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/notes_of_recording.h"

#include <cmath>
#include <numbers>

#include "harness/datasets/reading/image_association.h"

namespace vinebench::harness {
namespace {

/// Inverse of from_roll_pitch_yaw(), rad. Upright or upside down (pitch of 90 degrees) the roll is
/// taken to be zero.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d R = rotation.toRotationMatrix();
  const double level = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), level);
  if (level < 1e-9) return {0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

RigConfig::Camera config_of(const RigCamera& camera) {
  const PinholeCamera& model = camera.model;
  RigConfig::Camera config;
  config.name = camera.name;
  config.width = model.width;
  config.height = model.height;
  config.fx = model.fx;
  config.fy = model.fy;
  config.cx = model.cx;
  config.cy = model.cy;
  config.lens = model.lens;
  config.distortion = model.coefficients();
  config.position = camera.T_body_cam.translation;
  const Eigen::Quaterniond R_view_cam = Rig::mount({0, 0, 0}, {0, 0, 0}).rotation;
  config.rpy_deg = roll_pitch_yaw(camera.T_body_cam.rotation * R_view_cam.conjugate()) *
                   (180.0 / std::numbers::pi);
  return config;
}

/// Hz, of the median time between two readings.
double rate_of(const std::vector<ImuSample>& readings) {
  std::vector<Stamp> stamps;
  for (const ImuSample& reading : readings) stamps.push_back(reading.stamp);
  const Stamp period = median_period(stamps);
  return period > 0 ? 1 / to_seconds(period) : RecordingNotes().imu_rate_hz;
}

}  // namespace

RigConfig config_of(const Rig& rig) {
  RigConfig config;
  config.name = rig.name;
  config.rate_hz = rig.rate_hz;
  config.imu = rig.imu;
  const auto name_of = [&](int camera) {
    return rig.cameras.at(static_cast<std::size_t>(camera)).name;
  };
  for (const RigCamera& camera : rig.cameras) config.cameras.push_back(config_of(camera));
  for (const StereoPair& pair : rig.stereo_pairs) {
    config.stereo_pairs.push_back({pair.name, name_of(pair.left), name_of(pair.right)});
  }
  for (const int camera : rig.tag_cameras) config.tag_cameras.push_back(name_of(camera));
  return config;
}

RecordingNotes notes_of(const Recording& recording) {
  RecordingNotes notes;
  notes.rig = config_of(recording.rig);
  notes.tags = recording.tags;
  notes.imu_rate_hz = rate_of(recording.imu);
  notes.imu = recording.rig.imu.value_or(ImuNoise());
  notes.scenario = recording.name;
  notes.true_cameras = recording.rig.cameras;
  return notes;
}

}  // namespace vinebench::harness
