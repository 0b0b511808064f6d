// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/rig.h"

#include <numbers>

#include "core/config/yaml.h"
#include "core/util/error.h"

namespace vinebench {

int Rig::find_camera(const std::string& camera) const {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].name == camera) return static_cast<int>(i);
  }
  return -1;
}

double Rig::baseline(const StereoPair& pair) const {
  return (cameras[pair.left].T_body_cam.translation - cameras[pair.right].T_body_cam.translation)
      .norm();
}

Pose Rig::mount(const Eigen::Vector3d& position, const Eigen::Vector3d& rpy) {
  Eigen::Matrix3d R_view_cam;  // view axes: x ahead, y left, z up
  R_view_cam << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {(from_roll_pitch_yaw(rpy) * Eigen::Quaterniond(R_view_cam)).normalized(), position};
}

Rig Rig::stereo(const PinholeCamera& lens, double baseline) {
  Rig rig;
  rig.name = "stereo";
  rig.cameras = {{"left", lens, mount({0, 0, 0}, {0, 0, 0})},
                 {"right", lens, mount({0, -baseline, 0}, {0, 0, 0})}};
  rig.stereo_pairs = {{"stereo", 0, 1}};
  return rig;
}

Rig RigConfig::make() const {
  Rig rig;
  rig.name = name;
  rig.rate_hz = rate_hz;
  rig.imu = imu;
  for (const Camera& c : cameras) {
    if (c.name.starts_with('.') || c.name.find('/') != std::string::npos) {
      fail("rig '{}': camera '{}': expected a name without '/' that begins with no '.'", name,
           c.name);  // files and folders are named after it
    }
    PinholeCamera model{c.width, c.height, c.fx, c.fy, 0, 0};
    model.set_lens(c.lens, c.distortion);
    model.cx = c.cx.value_or((c.width - 1) / 2.0);
    model.cy = c.cy.value_or((c.height - 1) / 2.0);
    rig.cameras.push_back(
        {c.name, model, Rig::mount(c.position, c.rpy_deg * (std::numbers::pi / 180.0))});
  }
  const auto index_of = [&](const std::string& camera) {
    const int index = rig.find_camera(camera);
    if (index < 0) fail("rig '{}': no camera is named '{}'", name, camera);
    return index;
  };
  for (const Pair& pair : stereo_pairs) {
    rig.stereo_pairs.push_back({pair.name, index_of(pair.left), index_of(pair.right)});
  }
  for (const std::string& camera : tag_cameras) rig.tag_cameras.push_back(index_of(camera));
  return rig;
}

Rig load_rig(const std::filesystem::path& file) {
  return YamlDocument::load(file).read<RigConfig>().make();
}

}  // namespace vinebench
