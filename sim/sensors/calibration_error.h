// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"

namespace vinebench::sim {

/// Difference of the true rig, which takes the images, from the nominal one. None by default.
struct CalibrationErrorConfig {
  /// A fixed error of one camera, added to the drawn one.
  struct Camera {
    std::string name;                                        ///< of the camera in the rig
    Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m, along the camera's x, y, z
    Eigen::Vector3d rotation_deg = Eigen::Vector3d::Zero();  ///< rotation vector in its own axes
    Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();      ///< error of fx, fy
    Eigen::Vector2d principal_point_px = Eigen::Vector2d::Zero();  ///< error of cx, cy
    std::array<double, 4> distortion{};  ///< k1, k2, p1, p2 added to the nominal ones
    template <class Archive>
    void serialize(Archive& archive) {
      archive("name", name);
      archive("position", position, Range::between(-10, 10));
      archive("rotation_deg", rotation_deg, Range::between(-180, 180));
      archive("focal_px", focal_px, Range::between(-1e4, 1e4));
      archive("principal_point_px", principal_point_px, Range::between(-1e4, 1e4));
      archive("distortion", distortion, Range::between(-10, 10));
    }
  };
  // Standard deviations of the errors drawn for every camera.
  double position = 0;            ///< m, along each axis
  double rotation_deg = 0;        ///< about each axis
  double focal_px = 0;            ///< the same draw for x and y
  double principal_point_px = 0;  ///< in each direction
  std::vector<Camera> cameras;
  bool any() const {
    return position > 0 || rotation_deg > 0 || focal_px > 0 || principal_point_px > 0 ||
           !cameras.empty();
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("position", position, Range::between(0, 1));
    archive("rotation_deg", rotation_deg, Range::between(0, 45));
    archive("focal_px", focal_px, Range::between(0, 1000));
    archive("principal_point_px", principal_point_px, Range::between(0, 1000));
    archive("cameras", cameras);
  }
};

/// The true rig for the nominal one. Throws Error for an unknown camera name and a focal length
/// that is not above 0.
Rig true_rig(const Rig& told, const CalibrationErrorConfig& config, std::uint64_t seed);

}  // namespace vinebench::sim
