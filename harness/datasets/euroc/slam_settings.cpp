// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/slam_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "core/util/error.h"
#include "harness/datasets/euroc/rig_settings.h"
#include "harness/datasets/euroc/settings_text.h"
#include "harness/datasets/format/rectified.h"

namespace vinebench::harness {
namespace {

constexpr double kFarthest = 40;  // baselines, limit of depths

/// The common content of all files.
struct Setup {
  RigCamera left;
  RigCamera right;
  double rate_hz = 0;
  double baseline = 0;
  bool rectified = false;
  RecordingNotes notes;
  std::vector<RigCamera> pair() const { return {left, right}; }
  Pose T_left_right() const { return left.T_body_cam.inverse() * right.T_body_cam; }
};

Setup setup_of(const Rig& rig, const StereoPair& pair, const RecordingNotes& notes) {
  return {rig.cameras[static_cast<std::size_t>(pair.left)],
          rig.cameras[static_cast<std::size_t>(pair.right)],
          rig.rate_hz,
          rig.baseline(pair),
          is_rectified(rig, pair),
          notes};
}

/// A 4 x 4 matrix in OpenCV's YAML format.
std::string opencv_matrix(const std::string& key, const Pose& T) {
  return fmt::format("{}: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n  data: [{}]\n", key,
                     reals(row_major(T.matrix())));
}

std::string orbslam_camera(const std::string& name, const PinholeCamera& c, bool distortion) {
  std::string text = fmt::format("{0}.fx: {1}\n{0}.fy: {2}\n{0}.cx: {3}\n{0}.cy: {4}\n", name,
                                 real(c.fx), real(c.fy), real(c.cx), real(c.cy));
  if (!distortion) return text;
  constexpr std::array<const char*, 4> kKeys{"k1", "k2", "p1", "p2"};
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    text += fmt::format("{}.{}: {}\n", name, kKeys[i], real(c.distortion[i]));
  }
  return text;
}

/// Keys for rectified and raw cameras. The viewer's keys are required even without a viewer.
std::string orbslam_common(const Setup& setup) {
  const auto& [gyroscope, accelerometer] = setup.notes.imu;
  std::string text = fmt::format(
      "Camera.width: {}\nCamera.height: {}\nCamera.fps: {}\nCamera.RGB: 1\nStereo.ThDepth: {}\n",
      setup.left.model.width, setup.left.model.height, std::lround(setup.rate_hz), real(kFarthest));
  text += opencv_matrix("IMU.T_b_c1", setup.left.T_body_cam);
  text += fmt::format(
      "IMU.NoiseGyro: {}\nIMU.NoiseAcc: {}\nIMU.GyroWalk: {}\nIMU.AccWalk: {}\n"
      "IMU.Frequency: {}\n",
      real(noise(gyroscope.noise_density)), real(noise(accelerometer.noise_density)),
      real(noise(gyroscope.bias_random_walk)), real(noise(accelerometer.bias_random_walk)),
      real(setup.notes.imu_rate_hz));
  text +=
      "ORBextractor.nFeatures: 1200\nORBextractor.scaleFactor: 1.2\nORBextractor.nLevels: 8\n"
      "ORBextractor.iniThFAST: 20\nORBextractor.minThFAST: 7\n"
      "Viewer.KeyFrameSize: 0.05\nViewer.KeyFrameLineWidth: 1.0\nViewer.GraphLineWidth: 0.9\n"
      "Viewer.PointSize: 2.0\nViewer.CameraSize: 0.08\nViewer.CameraLineWidth: 3.0\n"
      "Viewer.ViewpointX: 0.0\nViewer.ViewpointY: -0.7\nViewer.ViewpointZ: -1.8\n"
      "Viewer.ViewpointF: 500.0\nViewer.imageViewScale: 1.0\n";
  return text;
}

/// Two pinhole cameras, with or without distortion. Not ORB-SLAM3's type "Rectified" for rectified
/// pairs: its release 1.0 crashes on it, because it prints a second camera that this type lacks.
std::string orbslam(const Setup& setup, bool distortion) {
  return "%YAML:1.0\nFile.version: \"1.0\"\nCamera.type: \"PinHole\"\n" +
         orbslam_camera("Camera1", setup.left.model, distortion) +
         orbslam_camera("Camera2", setup.right.model, distortion) +
         opencv_matrix("Stereo.T_c1_c2", setup.T_left_right()) + orbslam_common(setup);
}

std::string stella_camera(const char* camera, const PinholeCamera& c) {
  const std::vector<double> K{c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
  const auto& d = c.distortion;
  return fmt::format("  K_{0}: [{1}]\n  D_{0}: [{2}]\n", camera, reals(K),
                     reals({d.begin(), d.end()}));
}

/// For a pair that is not rectified, stella_vslam needs rotations to a common plane.
std::string stella(const Setup& setup) {
  const PinholeCamera& c = setup.left.model;
  std::string text = fmt::format(
      "Camera:\n  name: {}\n  setup: stereo\n  model: perspective\n  fx: {}\n  fy: {}\n  cx: {}\n"
      "  cy: {}\n  k1: 0.0\n  k2: 0.0\n  p1: 0.0\n  p2: 0.0\n  k3: 0.0\n  fps: {}\n  cols: {}\n"
      "  rows: {}\n  color_order: Gray\n  focal_x_baseline: {}\n  depth_threshold: {}\n",
      setup.notes.rig.name, real(c.fx), real(c.fy), real(c.cx), real(c.cy), real(setup.rate_hz),
      c.width, c.height, real(c.fx * setup.baseline), real(kFarthest));
  if (!setup.rectified) {
    const Pose T_left_right = setup.T_left_right();
    const Eigen::Vector3d x = T_left_right.translation.normalized();
    const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
    Eigen::Matrix3d R_plane_left;
    R_plane_left << x.transpose(), y.transpose(), x.cross(y).transpose();
    text += "StereoRectifier:\n  model: perspective\n" + stella_camera("left", c) +
            fmt::format("  R_left: [{}]\n", reals(row_major(R_plane_left))) +
            stella_camera("right", setup.right.model) +
            fmt::format("  R_right: [{}]\n",
                        reals(row_major(R_plane_left * T_left_right.rotation.toRotationMatrix())));
  }
  return text +
         "Preprocessing:\n  min_size: 800\nFeature:\n  name: ORB\n  scale_factor: 1.2\n"
         "  num_levels: 8\n  ini_fast_threshold: 20\n  min_fast_threshold: 7\n";
}

/// The lens that all of these systems have.
bool has_four_coefficients(const PinholeCamera& c) {
  return c.lens == LensModel::kRadialTangential && c.coefficients().size() == 4;
}

}  // namespace

std::vector<SettingsFile> slam_settings(const RecordingNotes& notes) {
  const Rig rig = notes.rig.make();
  if (rig.stereo_pairs.empty()) fail("settings: rig '{}' has no stereo pair", rig.name);
  if (!std::ranges::all_of(rig.cameras, has_four_coefficients, &RigCamera::model)) return {};
  const Setup setup = setup_of(rig, rig.stereo_pairs.front(), notes);
  std::vector<SettingsFile> files{{"orbslam3_raw.yaml", orbslam(setup, true)},
                                  {"basalt_calib.json", basalt_settings(setup.pair(), notes)},
                                  {"kalibr_imucam_chain.yaml", kalibr_chain(setup.pair())},
                                  {"kalibr_imu_chain.yaml", kalibr_imu(notes)},
                                  {"stella_vslam.yaml", stella(setup)}};
  if (setup.rectified) files.push_back({"orbslam3_rectified.yaml", orbslam(setup, false)});
  for (std::size_t i = 1; i < rig.stereo_pairs.size(); ++i) {
    const StereoPair& pair = rig.stereo_pairs[i];
    files.push_back({fmt::format("basalt_calib_{}.json", pair.name),
                     basalt_settings(setup_of(rig, pair, notes).pair(), notes)});
  }
  const std::vector<SettingsFile> of_rig = rig_settings(rig, notes);
  files.insert(files.end(), of_rig.begin(), of_rig.end());
  return files;
}

}  // namespace vinebench::harness
