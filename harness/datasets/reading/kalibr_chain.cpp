// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/kalibr_chain.h"

#include <fmt/format.h>

#include "core/config/yaml.h"
#include "core/util/error.h"
#include "harness/datasets/reading/sensor_file.h"

namespace vinebench::harness {

bool is_kalibr_chain(const std::filesystem::path& file) {
  const YAML::Node tree = load_yaml_tree(file);
  return tree.IsMap() && tree["cam0"].IsDefined();
}

Rig load_kalibr_chain(const std::filesystem::path& file) {
  const SensorFile chain(file);
  Rig rig;
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
  }
  if (rig.cameras.size() < 2) {
    fail("{}: expected a cam1 beside cam0: a stereo pair", file.string());
  }
  pair_in_order(rig);
  return rig;
}

void pair_in_order(Rig& rig) {
  const auto cameras = static_cast<int>(rig.cameras.size());
  rig.stereo_pairs.push_back({"front", 0, 1});
  if (cameras >= 4) rig.stereo_pairs.push_back({"back", 2, 3});
  for (int i = cameras >= 4 ? 4 : 2; i < cameras; ++i) rig.tag_cameras.push_back(i);
}

}  // namespace vinebench::harness
