// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/gl_renderer.h"

#include <map>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "core/truth/body_flow.h"
#include "core/util/error.h"
#include "sim/render/camera_check.h"
#include "sim/render/gl/painter.h"
#include "sim/render/gl/platform/gl_context.h"
#include "sim/render/gl/platform/gl_objects.h"
#include "sim/render/gl/read_back.h"

namespace vinebench::sim {
class GlRenderer::Impl {
 public:
  Impl(const Scene& scene, const RendererConfig& config)
      : config_(config),
        motions_(scene.motions),
        windy_(scene.wind.speed > 0),
        context_(make_gl_context(config.backend)) {
    const CurrentContext current(*context_);
    painter_ = std::make_unique<Painter>(current.gl(), scene, config.shadow_map_size);
  }
  ~Impl() {
    const CurrentContext current(*context_);
    targets_.clear();
    painter_.reset();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const RenderRequest& request) {
    check_camera(camera);
    const TruthParts truth{request.depth, request.instances || tells_movers_apart(request),
                           request.normals, request.motion && windy_};
    CurrentContext current(*context_);
    painter_->draw(target(current.gl(), camera.width, camera.height, truth.any()), camera,
                   T_world_cam, request.T_world_rover, config_.lod_scale * request.detail,
                   {request.exposure, request.time, request.other_time}, truth);
    current.wait();
    RenderedImage image = read(current.gl(), camera, request);
    if (request.motion) {
      const cv::Mat depth = request.depth ? image.depth : read_depth(current.gl(), camera);
      add_motion(camera, T_world_cam, request, depth, image);
    }
    check_gl(current.gl(), "drawing an image");
    if (!request.labels) image.labels.release();
    if (!request.instances) image.instances.release();
    return image;
  }

 private:
  const GlTarget& target(const GlFunctions& gl, int width, int height, bool truth) {
    return targets_.try_emplace({width, height, truth}, gl, width, height, truth).first->second;
  }

  bool tells_movers_apart(const RenderRequest& request) const {
    return request.motion && !motions_.empty();
  }

  /// Of the rover and of all that moves; the shaders know of the wind alone.
  void add_motion(const PinholeCamera& camera, const Pose& T_world_cam,
                  const RenderRequest& request, const cv::Mat& depth, RenderedImage& image) const {
    if (request.T_world_rover && request.T_world_rover_other) {
      move_rover(camera, T_world_cam, *request.T_world_rover, *request.T_world_rover_other,
                 image.labels, depth, image.motion);
    }
    const Stamp now = from_seconds(request.time), other = from_seconds(request.other_time);
    for (const Motion& motion : motions_) {
      cv::Mat mask;
      const int number = 256 * (motion.instance + 1);
      cv::inRange(image.instances, number, number + 255, mask);
      move_body(camera, T_world_cam, motion.T_world_model(now), motion.T_world_model(other), mask,
                depth, image.motion);
    }
  }

  RenderedImage read(const GlFunctions& gl, const PinholeCamera& camera,
                     const RenderRequest& request) {
    RenderedImage image;
    const cv::Size size(camera.width, camera.height);
    read_back_.colours(gl, size, image.rgb, image.labels);
    if (request.depth) read_back_.depth(gl, size, image.depth);
    if (request.instances || tells_movers_apart(request)) {
      read_back_.instances(gl, size, image.instances);
    }
    if (request.normals) read_back_.normals(gl, size, image.normals);
    if (request.motion && windy_) read_back_.motion(gl, size, image.motion);
    return image;
  }

  cv::Mat read_depth(const GlFunctions& gl, const PinholeCamera& camera) {
    cv::Mat depth;
    read_back_.depth(gl, {camera.width, camera.height}, depth);
    return depth;
  }

  RendererConfig config_;
  std::vector<Motion> motions_;
  bool windy_;  ///< else nothing moves by itself, and the target of motion is not drawn
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Painter> painter_;
  std::map<std::tuple<int, int, bool>, GlTarget> targets_;  // by width, height, truth
  ReadBack read_back_;
};

GlRenderer::GlRenderer(const Scene& scene, const RendererConfig& config)
    : impl_(std::make_unique<Impl>(scene, config)) {}
GlRenderer::GlRenderer(GlRenderer&&) noexcept = default;
GlRenderer& GlRenderer::operator=(GlRenderer&&) noexcept = default;
GlRenderer::~GlRenderer() = default;

RenderedImage GlRenderer::render(const PinholeCamera& camera, const Pose& T_world_cam,
                                 const RenderRequest& request) {
  return impl_->render(camera, T_world_cam, request);
}

}  // namespace vinebench::sim
