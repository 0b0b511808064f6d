// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "core/truth/truth_images.h"

namespace vinebench::sim {

/// What an engine gives of a view beside its colours, and at what instant.
struct RenderRequest {
  bool labels = false;
  bool depth = false;
  bool instances = false;
  bool normals = false;
  bool motion = false;
  double exposure = 1;    ///< all light is multiplied by this before it is encoded
  double time = 0;        ///< s, for Scene::motions and what the wind moves
  double other_time = 0;  ///< s, for motion
  double detail = 1;      ///< factor on the distances of the levels of detail, of `gl`
  /// Where Scene::rover_model stands; it is not there, and casts no shadow, where absent.
  std::optional<Pose> T_world_rover = std::nullopt;
  /// The same at other_time, for motion; it stays where absent.
  std::optional<Pose> T_world_rover_other = std::nullopt;
};

/// Draws one scene from any pinhole camera. One thread uses an engine at a time, but several may
/// work side by side. The same scene, pose and request give the same bytes in each.
class RenderEngine {
 public:
  virtual ~RenderEngine() = default;

  /// Light as it reaches the lens. Throws Error for a camera with distortion, or of no size, and
  /// for what the engine cannot give.
  virtual RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                               const RenderRequest& request) = 0;

 protected:
  RenderEngine() = default;
  RenderEngine(const RenderEngine&) = default;
  RenderEngine& operator=(const RenderEngine&) = default;
};

/// What the truth images of two views need of an engine, drawn at `time` and compared with a view
/// of `other_time` (s; of account only where something moves).
inline RenderRequest truth_request(double time = 0, double other_time = 0) {
  RenderRequest request;
  request.labels = request.depth = request.instances = request.normals = request.motion = true;
  request.time = time;
  request.other_time = other_time;
  return request;
}

}  // namespace vinebench::sim
