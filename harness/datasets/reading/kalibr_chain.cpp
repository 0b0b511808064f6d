// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/kalibr_chain.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/yaml.h"
#include "core/util/error.h"
#include "harness/datasets/reading/sensor_file.h"

namespace vinebench::harness {

bool is_kalibr_chain(const std::filesystem::path& file) {
  const YAML::Node tree = load_yaml_tree(file);
  return tree.IsMap() && tree["cam0"].IsDefined();
}

KalibrChain load_kalibr_chain(const std::filesystem::path& file) {
  const SensorFile chain(file);
  KalibrChain result;
  Rig& rig = result.rig;
  rig.name = "Kalibr";
  rig.rate_hz = 0;
  // The reference is the inertial unit where the first camera has its place on it.
  Pose T_cam_reference;
  bool on_unit = false;
  for (int i = 0;; ++i) {
    const std::string name = fmt::format("cam{}", i);
    const auto part = chain.part(name);
    if (!part) break;
    const auto T_cam_imu = part->transform("T_cam_imu");
    if (i == 0) on_unit = T_cam_imu.has_value();
    if (on_unit && T_cam_imu) {
      T_cam_reference = *T_cam_imu;
    } else if (i == 0) {
      T_cam_reference = Rig::mount(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()).inverse();
    } else if (const auto T_cam_before = part->transform("T_cn_cnm1")) {
      T_cam_reference = *T_cam_before * T_cam_reference;
    } else {
      part->fault(fmt::format("{}: expected T_cam_imu or T_cn_cnm1", name));
    }
    rig.cameras.push_back({name, part->camera(), T_cam_reference.inverse()});
    result.image_delays.push_back(from_seconds(part->seconds("timeshift_cam_imu").value_or(0)));
  }
  if (rig.cameras.size() < 2) {
    fail("{}: expected a cam1 beside cam0: a stereo pair", file.string());
  }
  if (std::ranges::count(result.image_delays, 0) == std::ssize(rig.cameras)) {
    result.image_delays.clear();
  }
  pair_in_order(rig);
  return result;
}

void pair_in_order(Rig& rig) {
  const auto cameras = static_cast<int>(rig.cameras.size());
  rig.stereo_pairs.push_back({"front", 0, 1});
  if (cameras >= 4) rig.stereo_pairs.push_back({"back", 2, 3});
  for (int i = cameras >= 4 ? 4 : 2; i < cameras; ++i) rig.tag_cameras.push_back(i);
}

}  // namespace vinebench::harness
