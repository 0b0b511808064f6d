// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/slam_settings.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/format/rectified.h"

namespace vinebench::harness {
namespace {

constexpr double kFarthest = 40;      // baselines, limit of depths
constexpr double kLeastNoise = 1e-6;  // other systems divide by it

/// The common content of all files.
struct Setup {
  RigCamera left;
  RigCamera right;
  double rate_hz = 0;
  double baseline = 0;
  bool rectified = false;
  RecordingNotes notes;
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

/// With a decimal point, which ORB-SLAM3 requires.
std::string real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    if (text.find('.') == std::string::npos) text.insert(e, ".0");
  }
  return text;
}

std::vector<double> row_major(const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      values.push_back(matrix(row, column));
    }
  }
  return values;
}

std::string reals(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(real(value));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// A 4 x 4 matrix in OpenCV's YAML format.
std::string opencv_matrix(const std::string& key, const Pose& T) {
  return fmt::format("{}: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n  data: [{}]\n", key,
                     reals(row_major(T.matrix())));
}

double noise(double density) {
  return std::max(density, kLeastNoise);
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

using Json = nlohmann::ordered_json;

Json basalt_intrinsics(const PinholeCamera& c) {
  Json values{{"fx", c.fx}, {"fy", c.fy}, {"cx", c.cx}, {"cy", c.cy}};
  if (!c.has_distortion()) return {{"camera_type", "pinhole"}, {"intrinsics", values}};
  constexpr std::array<const char*, 4> kKeys{"k1", "k2", "p1", "p2"};
  for (std::size_t i = 0; i < kKeys.size(); ++i) values[kKeys[i]] = c.distortion[i];
  for (const char* key : {"k3", "k4", "k5", "k6", "rpmax"}) values[key] = 0.0;
  return {{"camera_type", "pinhole-radtan8"}, {"intrinsics", values}};
}

/// One pair: Basalt reads the images of two cameras.
std::string basalt(const Setup& setup) {
  Json value;
  for (const RigCamera& camera : {setup.left, setup.right}) {
    const Eigen::Vector3d& p = camera.T_body_cam.translation;
    const Eigen::Quaterniond& q = camera.T_body_cam.rotation;
    value["T_imu_cam"].push_back({{"px", p.x()},
                                  {"py", p.y()},
                                  {"pz", p.z()},
                                  {"qx", q.x()},
                                  {"qy", q.y()},
                                  {"qz", q.z()},
                                  {"qw", q.w()}});
    value["intrinsics"].push_back(basalt_intrinsics(camera.model));
    value["resolution"].push_back({camera.model.width, camera.model.height});
  }
  const auto three = [](double density) { return Json(std::vector<double>(3, noise(density))); };
  value["vignette"] = Json::array();
  value["calib_accel_bias"] = std::vector<double>(9, 0.0);
  value["calib_gyro_bias"] = std::vector<double>(12, 0.0);
  value["imu_update_rate"] = setup.notes.imu_rate_hz;
  value["accel_noise_std"] = three(setup.notes.imu.accelerometer.noise_density);
  value["gyro_noise_std"] = three(setup.notes.imu.gyroscope.noise_density);
  value["accel_bias_std"] = three(setup.notes.imu.accelerometer.bias_random_walk);
  value["gyro_bias_std"] = three(setup.notes.imu.gyroscope.bias_random_walk);
  value["cam_time_offset_ns"] = 0;
  return json_text(Json{{"value0", value}}, 2) + "\n";
}

/// A matrix as a list of its rows.
std::string kalibr_matrix(const std::string& key, const Eigen::MatrixXd& matrix) {
  std::string text = fmt::format("  {}:\n", key);
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    text += fmt::format("    - [{}]\n", reals(row_major(matrix.row(row))));
  }
  return text;
}

std::string kalibr_cameras(const Setup& setup) {
  std::string text = "%YAML:1.0\n";
  for (const int index : {0, 1}) {
    const RigCamera& camera = index == 0 ? setup.left : setup.right;
    const PinholeCamera& c = camera.model;
    text += fmt::format("cam{}:\n", index);
    text += kalibr_matrix("T_cam_imu", camera.T_body_cam.inverse().matrix());
    if (index == 1) text += kalibr_matrix("T_cn_cnm1", setup.T_left_right().inverse().matrix());
    text += fmt::format(
        "  cam_overlaps: [{}]\n  camera_model: pinhole\n  distortion_coeffs: [{}]\n"
        "  distortion_model: radtan\n  intrinsics: [{}]\n  resolution: [{}, {}]\n"
        "  rostopic: /cam{}/image_raw\n  timeshift_cam_imu: 0.0\n",
        1 - index, reals({c.distortion.begin(), c.distortion.end()}),
        reals({c.fx, c.fy, c.cx, c.cy}), c.width, c.height, index);
  }
  return text;
}

std::string kalibr_imu(const Setup& setup) {
  const auto& [gyroscope, accelerometer] = setup.notes.imu;
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  std::string text = "%YAML:1.0\nimu0:\n";
  text += kalibr_matrix("T_i_b", Eigen::Matrix4d::Identity());
  text += fmt::format(
      "  accelerometer_noise_density: {}\n  accelerometer_random_walk: {}\n"
      "  gyroscope_noise_density: {}\n  gyroscope_random_walk: {}\n  rostopic: /imu0\n"
      "  time_offset: 0.0\n  update_rate: {}\n  model: kalibr\n",
      real(noise(accelerometer.noise_density)), real(noise(accelerometer.bias_random_walk)),
      real(noise(gyroscope.noise_density)), real(noise(gyroscope.bias_random_walk)),
      real(setup.notes.imu_rate_hz));
  for (const char* key : {"Tw", "R_IMUtoGYRO", "Ta", "R_IMUtoACC"}) text += kalibr_matrix(key, one);
  return text + kalibr_matrix("Tg", Eigen::Matrix3d::Zero());
}

std::string stella_camera(const char* camera, const PinholeCamera& c) {
  const std::vector<double> K{c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
  const auto& d = c.distortion;
  return fmt::format("  K_{0}: [{1}]\n  D_{0}: [{2}]\n", camera, reals(K),
                     reals({d[0], d[1], d[2], d[3], 0}));
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

}  // namespace

std::vector<SettingsFile> slam_settings(const RecordingNotes& notes) {
  const Rig rig = notes.rig.make();
  if (rig.stereo_pairs.empty()) fail("settings: rig '{}' has no stereo pair", rig.name);
  const Setup setup = setup_of(rig, rig.stereo_pairs.front(), notes);
  std::vector<SettingsFile> files{{"orbslam3_raw.yaml", orbslam(setup, true)},
                                  {"basalt_calib.json", basalt(setup)},
                                  {"kalibr_imucam_chain.yaml", kalibr_cameras(setup)},
                                  {"kalibr_imu_chain.yaml", kalibr_imu(setup)},
                                  {"stella_vslam.yaml", stella(setup)}};
  if (setup.rectified) files.push_back({"orbslam3_rectified.yaml", orbslam(setup, false)});
  for (std::size_t i = 1; i < rig.stereo_pairs.size(); ++i) {
    const StereoPair& pair = rig.stereo_pairs[i];
    files.push_back(
        {fmt::format("basalt_calib_{}.json", pair.name), basalt(setup_of(rig, pair, notes))});
  }
  return files;
}

}  // namespace vinebench::harness
