// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/rig_settings.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/datasets/euroc/settings_text.h"
#include "harness/datasets/files/json_file.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kGravity = 9.81;  // m/s^2, that of the simulation

Json basalt_intrinsics(const PinholeCamera& c) {
  Json values{{"fx", c.fx}, {"fy", c.fy}, {"cx", c.cx}, {"cy", c.cy}};
  if (!c.has_distortion()) return {{"camera_type", "pinhole"}, {"intrinsics", values}};
  constexpr std::array<const char*, 4> kKeys{"k1", "k2", "p1", "p2"};
  for (std::size_t i = 0; i < kKeys.size(); ++i) values[kKeys[i]] = c.distortion[i];
  for (const char* key : {"k3", "k4", "k5", "k6", "rpmax"}) values[key] = 0.0;
  return {{"camera_type", "pinhole-radtan8"}, {"intrinsics", values}};
}

/// A matrix as a list of its rows.
std::string kalibr_matrix(const std::string& key, const Eigen::MatrixXd& matrix) {
  std::string text = fmt::format("  {}:\n", key);
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    text += fmt::format("    - [{}]\n", reals(row_major(matrix.row(row))));
  }
  return text;
}

/// Cameras that look roughly the same way see the same things.
std::vector<std::size_t> overlaps(const std::vector<RigCamera>& cameras, std::size_t camera) {
  constexpr double kLeastCosine = 0.5;
  const auto axis = [](const RigCamera& c) {
    return (c.T_body_cam.rotation * Eigen::Vector3d::UnitZ()).eval();
  };
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (i != camera && axis(cameras[i]).dot(axis(cameras[camera])) > kLeastCosine) {
      others.push_back(i);
    }
  }
  return others;
}

std::string okvis_camera(const RigCamera& camera) {
  const PinholeCamera& c = camera.model;
  return fmt::format(
      "  - T_SC: [{}]\n    image_dimension: [{}, {}]\n    distortion_coefficients: [{}]\n"
      "    distortion_type: radialtangential\n    focal_length: [{}, {}]\n"
      "    principal_point: [{}, {}]\n    camera_type: gray\n    slam_use: okvis\n",
      reals(row_major(camera.T_body_cam.matrix())), c.width, c.height, reals(c.coefficients()),
      real(c.fx), real(c.fy), real(c.cx), real(c.cy));
}

/// "0, 1, 2": all cameras expose at the same instant.
std::string sync_list(std::size_t cameras) {
  std::string text;
  for (std::size_t i = 0; i < cameras; ++i) text += fmt::format("{}{}", i == 0 ? "" : ", ", i);
  return text;
}

/// Cameras and inertial unit; what is not named keeps OKVIS2's own values.
std::string okvis_settings(const std::vector<RigCamera>& cameras, const RecordingNotes& notes) {
  const auto& [gyroscope, accelerometer] = notes.imu;
  std::string text = "%YAML:1.0\ncameras:\n";
  for (const RigCamera& camera : cameras) text += okvis_camera(camera);
  return text + fmt::format(
                    "camera_parameters:\n  timestamp_tolerance: 0.005\n  sync_cameras: [{}]\n"
                    "  image_delay: 0.0\n  online_calibration:\n    do_extrinsics: false\n"
                    "imu_parameters:\n  use: true\n  a_max: 176.0\n  g_max: 7.8\n  sigma_g_c: {}\n"
                    "  sigma_a_c: {}\n  sigma_bg: 0.01\n  sigma_ba: 0.1\n  sigma_gw_c: {}\n"
                    "  sigma_aw_c: {}\n  a0: [0.0, 0.0, 0.0]\n  s_a: [1.0, 1.0, 1.0]\n  g0: [0.0, "
                    "0.0, 0.0]\n  g: {}\n"
                    "  T_BS: [{}]\n",
                    sync_list(cameras.size()), real(noise(gyroscope.noise_density)),
                    real(noise(accelerometer.noise_density)),
                    real(noise(gyroscope.bias_random_walk)),
                    real(noise(accelerometer.bias_random_walk)), real(kGravity),
                    reals(row_major(Eigen::Matrix4d::Identity())));
}

std::string comma_list(const std::vector<RigCamera>& cameras) {
  std::vector<std::string> names;
  for (const RigCamera& camera : cameras) names.push_back(camera.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// OpenVINS takes cameras 0 and 1, 2 and 3, ... as stereo pairs.
std::vector<RigCamera> pairs_first(const Rig& rig) {
  std::vector<int> order;
  for (const StereoPair& pair : rig.stereo_pairs)
    order.insert(order.end(), {pair.left, pair.right});
  for (int i = 0; i < static_cast<int>(rig.cameras.size()); ++i) {
    if (std::ranges::count(order, i) == 0) order.push_back(i);
  }
  std::vector<RigCamera> cameras;
  for (const int i : order) cameras.push_back(rig.cameras[static_cast<std::size_t>(i)]);
  return cameras;
}

/// Brown's model is k1, k2, k3, p1, p2 there.
Json edex_intrinsics(const PinholeCamera& c) {
  const auto& [k1, k2, p1, p2, k3] = c.distortion;
  const Json brown{k1, k2, k3, p1, p2};
  return {{"distortion_model", c.has_distortion() ? "brown" : "pinhole"},
          {"distortion_params", c.has_distortion() ? brown : Json::array()},
          {"focal", {c.fx, c.fy}},
          {"principal", {c.cx, c.cy}},
          {"size", {c.width, c.height}}};
}

/// The upper three rows.
Json edex_transform(const Pose& T_rig_cam) {
  const Eigen::Vector4d flip(1, -1, -1, 1);
  const Eigen::Matrix4d m = flip.asDiagonal() * T_rig_cam.matrix() * flip.asDiagonal();
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2), m(i, 3)});
  return rows;
}

/// Beside Kalibr's files; what is not named keeps OpenVINS' own values.
std::string openvins_settings(const Rig& rig) {
  return fmt::format(
      "%YAML:1.0\n# cameras in the order of openvins_imucam_chain.yaml: {}\nuse_stereo: {}\n"
      "max_cameras: {}\ngravity_mag: {}\ncalib_cam_extrinsics: false\n"
      "calib_cam_intrinsics: false\ncalib_cam_timeoffset: false\n"
      "relative_config_imu: \"kalibr_imu_chain.yaml\"\n"
      "relative_config_imucam: \"openvins_imucam_chain.yaml\"\n",
      comma_list(pairs_first(rig)), !rig.stereo_pairs.empty(), rig.cameras.size(), real(kGravity));
}

}  // namespace

std::string kalibr_chain(const std::vector<RigCamera>& cameras) {
  std::string text = "%YAML:1.0\n";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const PinholeCamera& c = cameras[i].model;
    const Pose T_cam_imu = cameras[i].T_body_cam.inverse();
    text += fmt::format("cam{}:\n", i) + kalibr_matrix("T_cam_imu", T_cam_imu.matrix());
    if (i > 0) {
      text += kalibr_matrix("T_cn_cnm1", (T_cam_imu * cameras[i - 1].T_body_cam).matrix());
    }
    text += fmt::format(
        "  cam_overlaps: [{}]\n  camera_model: pinhole\n  distortion_coeffs: [{}]\n"
        "  distortion_model: radtan\n  intrinsics: [{}]\n  resolution: [{}, {}]\n"
        "  rostopic: /cam{}/image_raw\n  timeshift_cam_imu: 0.0\n",
        fmt::join(overlaps(cameras, i), ", "), reals(c.coefficients()),
        reals({c.fx, c.fy, c.cx, c.cy}), c.width, c.height, i);
  }
  return text;
}

std::string kalibr_imu(const RecordingNotes& notes) {
  const auto& [gyroscope, accelerometer] = notes.imu;
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  std::string text = "%YAML:1.0\nimu0:\n";
  text += kalibr_matrix("T_i_b", Eigen::Matrix4d::Identity());
  text += fmt::format(
      "  accelerometer_noise_density: {}\n  accelerometer_random_walk: {}\n"
      "  gyroscope_noise_density: {}\n  gyroscope_random_walk: {}\n  rostopic: /imu0\n"
      "  time_offset: 0.0\n  update_rate: {}\n  model: kalibr\n",
      real(noise(accelerometer.noise_density)), real(noise(accelerometer.bias_random_walk)),
      real(noise(gyroscope.noise_density)), real(noise(gyroscope.bias_random_walk)),
      real(notes.imu_rate_hz));
  for (const char* key : {"Tw", "R_IMUtoGYRO", "Ta", "R_IMUtoACC"}) text += kalibr_matrix(key, one);
  return text + kalibr_matrix("Tg", Eigen::Matrix3d::Zero());
}

std::string basalt_settings(const std::vector<RigCamera>& cameras, const RecordingNotes& notes) {
  Json value;
  for (const RigCamera& camera : cameras) {
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
  value["imu_update_rate"] = notes.imu_rate_hz;
  value["accel_noise_std"] = three(notes.imu.accelerometer.noise_density);
  value["gyro_noise_std"] = three(notes.imu.gyroscope.noise_density);
  value["accel_bias_std"] = three(notes.imu.accelerometer.bias_random_walk);
  value["gyro_bias_std"] = three(notes.imu.gyroscope.bias_random_walk);
  value["cam_time_offset_ns"] = 0;
  return json_text(Json{{"value0", value}}, 2) + "\n";
}

std::string edex_settings(const Rig& rig) {
  Json cameras = Json::array();
  const std::vector<RigCamera> ordered = pairs_first(rig);
  for (std::size_t i = 0; i < 2 * rig.stereo_pairs.size(); ++i) {
    const Pose T_rig_cam = ordered.front().T_body_cam.inverse() * ordered[i].T_body_cam;
    cameras.push_back({{"intrinsics", edex_intrinsics(ordered[i].model)},
                       {"transform", edex_transform(T_rig_cam)}});
  }
  return json_text(Json::array({{{"cameras", cameras}}}), 2) + "\n";
}

std::vector<SettingsFile> rig_settings(const Rig& rig, const RecordingNotes& notes) {
  return {{"kalibr_imucam_chain_rig.yaml", kalibr_chain(rig.cameras)},
          {"basalt_calib_rig.json", basalt_settings(rig.cameras, notes)},
          {"okvis2.yaml", okvis_settings(rig.cameras, notes)},
          {"openvins.yaml", openvins_settings(rig)},
          {"openvins_imucam_chain.yaml", kalibr_chain(pairs_first(rig))},
          {"stereo.edex", edex_settings(rig)}};
}

}  // namespace vinebench::harness
