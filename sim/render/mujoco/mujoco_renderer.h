// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

struct MujocoRendererConfig {
  int width = 752;            ///< px, of the largest image
  int height = 480;           ///< px
  double level_distance = 0;  ///< m, for MujocoScene: 0 takes the finest meshes
  bool shadows = false;       ///< drawn anew for each image, as MuJoCo does
};

/// MuJoCo's own renderer on a software context, for comparison only. It lives and is used in one
/// thread, and no other GL context may be current there meanwhile.
class MujocoRenderer {
 public:
  /// Throws Error when the scene cannot be loaded or there is no context.
  MujocoRenderer(const Scene& scene, const MujocoRendererConfig& config);
  MujocoRenderer(MujocoRenderer&&) noexcept;
  MujocoRenderer& operator=(MujocoRenderer&&) noexcept;
  ~MujocoRenderer();

  /// CV_8UC3, RGB, top row first. Without distortion; the principal point's height is the middle.
  cv::Mat render(const PinholeCamera& camera, const Pose& T_world_cam);

  std::int64_t triangles() const;
  static std::string platform();  ///< "EGL (surfaceless)" or "OSMesa"

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vinebench::sim
