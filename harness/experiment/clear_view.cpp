// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/clear_view.h"

#include "core/truth/labels.h"
#include "sim/truth/truth.h"

namespace vinebench::harness {

ClearView::ClearView(const Rig& rig) : rig_(rig) {
  for (const int camera : rig.tag_cameras) {
    const PinholeCamera& model = rig.cameras[static_cast<std::size_t>(camera)].model;
    labels_.emplace_back(model.height, model.width, CV_8UC1,
                         cv::Scalar(static_cast<double>(Label::kTag)));
  }
}

std::vector<int> ClearView::of(const std::vector<WorldTag>& tags, const Pose& T_world_body) const {
  std::vector<int> seen;
  for (std::size_t tag = 0; tag < tags.size(); ++tag) {
    bool in_view = false;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      in_view = in_view || sees(i, tags[tag], T_world_body);
    }
    if (in_view) seen.push_back(static_cast<int>(tag));
  }
  return seen;
}

bool ClearView::sees(std::size_t tag_camera, const WorldTag& tag, const Pose& T_world_body) const {
  const RigCamera& camera = rig_.cameras[static_cast<std::size_t>(rig_.tag_cameras[tag_camera])];
  return sim::is_tag_visible(tag, camera.model, T_world_body * camera.T_body_cam,
                             labels_[tag_camera]);
}

Pose standing_at(const Eigen::Vector3d& pose, const sim::Terrain& terrain) {
  constexpr double kWheelReach = 0.2;  // m
  const Eigen::Vector2d place = pose.head<2>();
  const auto tilt = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(),
                                                       terrain.normal(place, kWheelReach));
  return {(tilt * from_roll_pitch_yaw({0, 0, pose.z()})).normalized(),
          {place.x(), place.y(), terrain.height(place)}};
}

}  // namespace vinebench::harness
