// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "sim/render/gl/platform/gl_objects.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// The uniform block that all shaders share, in std140's layout; colours are linear unless said.
struct ViewBlock {
  Eigen::Matrix4f clip_from_cam = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f cam_from_world = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f world_from_cam = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f shadow_from_cam = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f moving_shadow_from_cam = Eigen::Matrix4f::Identity();
  Eigen::Vector4f towards_sun = Eigen::Vector4f::Zero();  ///< camera frame
  Eigen::Vector4f up = Eigen::Vector4f::Zero();           ///< camera frame
  Eigen::Vector4f sun = Eigen::Vector4f::Zero();
  Eigen::Vector4f sky = Eigen::Vector4f::Zero();
  Eigen::Vector4f bounce = Eigen::Vector4f::Zero();
  Eigen::Vector4f haze = Eigen::Vector4f::Zero();       ///< encoded colour, extinction in 1/m
  Eigen::Vector4f light_map = Eigen::Vector4f::Zero();  ///< scale and offset from world x, y
  Eigen::Vector4f gust =
      Eigen::Vector4f::Zero();  ///< sway in m along x, y; time and other time in s
  Eigen::Vector4f gust_phase = Eigen::Vector4f::Zero();
  Eigen::Vector4f lens =
      Eigen::Vector4f::Zero();  ///< focal length, light map's and sky's brightness
};

/// What of a view does not come with the scene.
struct ViewSettings {
  double exposure = 1;    ///< all light is multiplied by this
  double time = 0;        ///< s, for all that moves
  double other_time = 0;  ///< s; motion is from `time` to this
};

/// The block of a camera in its place. The maps' fields are left to their owners.
ViewBlock make_view_block(const PinholeCamera& camera, const Pose& T_world_cam, const Light& light,
                          const Wind& wind, const ViewSettings& settings);

/// How a light value is stored in an image: sRGB taken as the power 1 / 2.2.
float encoded(double light);

/// A clear sky's radiance, as a share of that of a white wall in the open which it and the sun
/// light: cameras expose for the vines before it and keep its blue.
inline constexpr double kSkySeen = 0.5;

/// The light at the horizon, which haze fades to; linear RGB.
Eigen::Vector3f horizon_light(const Light& light);

/// A buffer on the card that holds a ViewBlock for all programs.
class ViewBuffer {
 public:
  explicit ViewBuffer(const GlFunctions& gl);
  void set(const ViewBlock& block) const;

 private:
  const GlFunctions& gl_;
  GlBuffer buffer_;
};

}  // namespace vinebench::sim
