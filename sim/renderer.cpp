// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/renderer.h"

#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "sim/frustum.h"
#include "sim/gl_context.h"
#include "sim/gl_objects.h"
#include "sim/painter.h"
#include "slam/base/error.h"

namespace vinebench {
namespace {

constexpr int kLargest = 8192;  // pixels a side

void check_camera(const PinholeCamera& camera) {
  if (camera.has_distortion()) {
    fail("renderer: the camera has lens distortion, expected an ideal pinhole");
  }
  if (camera.width < 1 || camera.height < 1 || camera.width > kLargest ||
      camera.height > kLargest) {
    fail("renderer: a picture of {} x {} pixels, expected 1 to {} a side", camera.width,
         camera.height, kLargest);
  }
  if (!(camera.fx > 0) || !(camera.fy > 0)) {
    fail("renderer: focal lengths of {} and {} px, expected more than 0", camera.fx, camera.fy);
  }
}

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

}  // namespace

class Renderer::Impl {
 public:
  Impl(const Scene& scene, const RendererConfig& config)
      : config_(config), context_(make_gl_context()) {
    const CurrentContext current(*context_);
    painter_ = std::make_unique<Painter>(scene, config.shadow_map_size);
  }
  ~Impl() {
    const CurrentContext current(*context_);
    targets_.clear();
    painter_.reset();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Picture render(const PinholeCamera& camera, const Pose& T_world_cam, const Request& request) {
    check_camera(camera);
    const CurrentContext current(*context_);
    target(camera.width, camera.height).bind();
    painter_->draw(camera, T_world_cam, config_.lod_scale);
    Picture picture = read(camera, request);
    check_gl("drawing a picture");
    return picture;
  }

 private:
  const GlTarget& target(int width, int height) {
    return targets_.try_emplace({width, height}, width, height).first->second;
  }

  /// The clip space is mirrored so that OpenGL's first row is the picture's top one.
  Picture read(const PinholeCamera& camera, const Request& request) {
    Picture picture;
    pixels_.create(camera.height, camera.width, CV_8UC4);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, camera.width, camera.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data);
    cv::cvtColor(pixels_, picture.rgb, cv::COLOR_RGBA2RGB);
    if (request.labels) cv::extractChannel(pixels_, picture.labels, 3);
    if (request.depth) {
      picture.depth.create(camera.height, camera.width, CV_32FC1);
      gl.ReadPixels(0, 0, camera.width, camera.height, GL_DEPTH_COMPONENT, GL_FLOAT,
                    picture.depth.data);
      linearise(picture.depth);
    }
    return picture;
  }

  RendererConfig config_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Painter> painter_;
  std::map<std::pair<int, int>, GlTarget> targets_;  // by width and height
  cv::Mat pixels_;                                   // RGB and label
};

Renderer::Renderer(const Scene& scene, const RendererConfig& config)
    : impl_(std::make_unique<Impl>(scene, config)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Picture Renderer::render(const PinholeCamera& camera, const Pose& T_world_cam,
                         const Request& request) {
  return impl_->render(camera, T_world_cam, request);
}

}  // namespace vinebench
