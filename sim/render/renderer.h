// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "core/truth/truth_images.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Which GL platform draws.
enum class GlBackend { kAuto, kOsmesa, kEgl };
inline std::vector<std::string> yaml_names(GlBackend) {
  return {"auto", "osmesa", "egl"};
}

struct RendererConfig {
  /// OSMesa and EGL give the same image; `auto` takes $VINEBENCH_GL, else OSMesa, else EGL.
  GlBackend backend = GlBackend::kAuto;
  double lod_scale = 1.0;      ///< distances of the levels of detail are multiplied by this
  int shadow_map_size = 2048;  ///< pixels a side; 0 draws no shadows
  template <class Archive>
  void serialize(Archive& archive) {
    archive("backend", backend);
    archive("lod_scale", lod_scale, Range::between(0.05, 20));
    archive("shadow_map_size", shadow_map_size, Range::between(0, 8192));
  }
};

/// Draws a scene from any pinhole camera. Owns a GL context; one thread uses it at a time, but
/// several renderers may work side by side, one a thread. The same scene and pose give the same
/// bytes in each.
class Renderer {
 public:
  /// Uploads the scene. Throws Error when no context or no memory is to be had.
  Renderer(const Scene& scene, const RendererConfig& config);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  struct Request {
    bool labels = false;
    bool depth = false;
    bool instances = false;
    bool normals = false;
    bool motion = false;
    double exposure = 1;    ///< all light is multiplied by this before it is encoded
    double time = 0;        ///< s, for what the wind moves
    double other_time = 0;  ///< s, for motion
    /// Where Scene::rover_model stands; it is not there, and casts no shadow, where absent.
    std::optional<Pose> T_world_rover = std::nullopt;
    /// The same at other_time, for motion; it stays where absent.
    std::optional<Pose> T_world_rover_other = std::nullopt;
  };
  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const Request& request);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What the truth images of two views need of the renderer, drawn at `time` and compared with a
/// view of `other_time` (s; of account only where the wind blows).
Renderer::Request truth_request(double time = 0, double other_time = 0);

}  // namespace vinebench::sim
