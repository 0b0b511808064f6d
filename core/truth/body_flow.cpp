// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/body_flow.h"

#include <opencv2/core.hpp>

#include "core/truth/labels.h"

namespace vinebench {

void move_body(const PinholeCamera& camera, const Pose& T_world_cam, const Pose& T_world_body,
               const Pose& T_world_body_other, const cv::Mat& mask, const cv::Mat& depth,
               cv::Mat& motion) {
  if (cv::countNonZero(mask) == 0) return;
  if (motion.empty()) motion = cv::Mat(depth.size(), CV_32FC3, cv::Scalar::all(0));
  const Pose other_from_this = T_world_body_other * T_world_body.inverse();
  for (int y = 0; y < depth.rows; ++y) {
    const auto* inside = mask.ptr<std::uint8_t>(y);
    auto* moved = motion.ptr<cv::Vec3f>(y);
    for (int x = 0; x < depth.cols; ++x) {
      if (inside[x] == 0) continue;
      const double z = static_cast<double>(depth.at<float>(y, x));
      const Eigen::Vector3d p = T_world_cam * (z * camera.unproject({x, y}));
      const Eigen::Vector3f displacement = (other_from_this * p - p).cast<float>();
      moved[x] = {displacement.x(), displacement.y(), displacement.z()};
    }
  }
}

void move_rover(const PinholeCamera& camera, const Pose& T_world_cam, const Pose& T_world_rover,
                const Pose& T_world_rover_other, const cv::Mat& labels, const cv::Mat& depth,
                cv::Mat& motion) {
  move_body(camera, T_world_cam, T_world_rover, T_world_rover_other,
            labels == static_cast<int>(Label::kRover), depth, motion);
}

}  // namespace vinebench
