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
#include "sim/render/gl/scene/frustum.h"

namespace vinebench::sim {
namespace {

/// OpenGL's depth to z along the optical axis, m; 0 where there is nothing but sky.
void linearise(cv::Mat& depth) {
  constexpr double kSpan = kFarPlane - kNearPlane;
  constexpr double kProduct = kFarPlane * kNearPlane;
  for (int y = 0; y < depth.rows; ++y) {
    auto* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) {
      row[x] = row[x] >= 1.0f ? 0.0f : static_cast<float>(kProduct / (kFarPlane - row[x] * kSpan));
    }
  }
}

/// Bytes of instance number (low, middle, high) and part to RenderedImage::instances.
cv::Mat instance_numbers(const cv::Mat& bytes) {
  cv::Mat numbers(bytes.size(), CV_32SC1);
  for (int y = 0; y < bytes.rows; ++y) {
    const auto* from = bytes.ptr<cv::Vec4b>(y);
    auto* to = numbers.ptr<std::int32_t>(y);
    for (int x = 0; x < bytes.cols; ++x) {
      const int number = from[x][0] | from[x][1] << 8 | from[x][2] << 16;
      to[x] = number << 8 | from[x][3];
    }
  }
  return numbers;
}

}  // namespace

class GlRenderer::Impl {
 public:
  Impl(const Scene& scene, const RendererConfig& config)
      : config_(config), motions_(scene.motions), context_(make_gl_context(config.backend)) {
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
                           request.normals, request.motion};
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

  /// The clip space is mirrored so that OpenGL's first row is the image's top one.
  RenderedImage read(const GlFunctions& gl, const PinholeCamera& camera,
                     const RenderRequest& request) {
    RenderedImage image;
    const cv::Size size(camera.width, camera.height);
    read_pixels(gl, 0, size, GL_RGBA, GL_UNSIGNED_BYTE, CV_8UC4, pixels_);
    image.rgb.create(size, CV_8UC3);
    image.labels.create(size, CV_8UC1);
    cv::Mat parts[] = {image.rgb, image.labels};
    constexpr int kFromTo[] = {0, 0, 1, 1, 2, 2, 3, 3};
    cv::mixChannels(&pixels_, 1, parts, 2, kFromTo, 4);
    if (request.depth) image.depth = read_depth(gl, camera);
    if (request.instances || tells_movers_apart(request)) {
      read_pixels(gl, 1, size, GL_RGBA, GL_UNSIGNED_BYTE, CV_8UC4, pixels_);
      image.instances = instance_numbers(pixels_);
    }
    if (request.normals) read_pixels(gl, 2, size, GL_RGB, GL_FLOAT, CV_32FC3, image.normals);
    if (request.motion) read_pixels(gl, 3, size, GL_RGB, GL_FLOAT, CV_32FC3, image.motion);
    return image;
  }

  static cv::Mat read_depth(const GlFunctions& gl, const PinholeCamera& camera) {
    cv::Mat depth;
    read_pixels(gl, 0, {camera.width, camera.height}, GL_DEPTH_COMPONENT, GL_FLOAT, CV_32FC1,
                depth);
    linearise(depth);
    return depth;
  }

  static void read_pixels(const GlFunctions& gl, int attachment, const cv::Size& size,
                          GLenum format, GLenum type, int mat_type, cv::Mat& pixels) {
    pixels.create(size, mat_type);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, size.width, size.height, format, type, pixels.data);
  }

  RendererConfig config_;
  std::vector<Motion> motions_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Painter> painter_;
  std::map<std::tuple<int, int, bool>, GlTarget> targets_;  // by width, height, truth
  cv::Mat pixels_;                                          // RGB and label
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
