// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/renderer.h"

#include <map>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

#include "core/truth/rover_flow.h"
#include "core/util/error.h"
#include "sim/render/gl/frustum.h"
#include "sim/render/gl/painter.h"
#include "sim/render/gl/platform/gl_context.h"
#include "sim/render/gl/platform/gl_objects.h"
#include "sim/sensors/camera/glare.h"

namespace vinebench::sim {
namespace {

constexpr int kLargest = 8192;  // pixels a side

void check_camera(const PinholeCamera& camera) {
  if (camera.has_distortion()) {
    fail("renderer: the camera has lens distortion, expected an ideal pinhole");
  }
  if (camera.width < 1 || camera.height < 1 || camera.width > kLargest ||
      camera.height > kLargest) {
    fail("renderer: an image of {} x {} pixels, expected 1 to {} a side", camera.width,
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

class Renderer::Impl {
 public:
  Impl(const Scene& scene, const RendererConfig& config)
      : config_(config), light_(scene.light), context_(make_gl_context(config.backend)) {
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

  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const Request& request) {
    check_camera(camera);
    const TruthParts truth{request.depth, request.instances, request.normals, request.motion};
    const CurrentContext current(*context_);
    painter_->draw(target(camera.width, camera.height, truth.any()), camera, T_world_cam,
                   request.T_world_rover, config_.lod_scale,
                   {request.exposure, request.time, request.other_time}, truth);
    RenderedImage image = read(camera, request);
    if (request.motion && request.T_world_rover && request.T_world_rover_other) {
      const cv::Mat depth = request.depth ? image.depth : read_depth(camera);
      move_rover(camera, T_world_cam, *request.T_world_rover, *request.T_world_rover_other,
                 image.labels, depth, image.motion);
    }
    check_gl("drawing an image");
    const Eigen::Vector3d sun = light_.towards_sun.cast<double>();
    add_glare(image.rgb, image.labels, camera, T_world_cam.rotation.inverse() * sun, light_,
              request.exposure);
    if (!request.labels) image.labels.release();
    return image;
  }

 private:
  const GlTarget& target(int width, int height, bool truth) {
    return targets_.try_emplace({width, height, truth}, width, height, truth).first->second;
  }

  /// The clip space is mirrored so that OpenGL's first row is the image's top one.
  RenderedImage read(const PinholeCamera& camera, const Request& request) {
    RenderedImage image;
    const cv::Size size(camera.width, camera.height);
    read_pixels(0, size, GL_RGBA, GL_UNSIGNED_BYTE, CV_8UC4, pixels_);
    image.rgb.create(size, CV_8UC3);
    image.labels.create(size, CV_8UC1);
    cv::Mat parts[] = {image.rgb, image.labels};
    constexpr int kFromTo[] = {0, 0, 1, 1, 2, 2, 3, 3};
    cv::mixChannels(&pixels_, 1, parts, 2, kFromTo, 4);
    if (request.depth) image.depth = read_depth(camera);
    if (request.instances) {
      read_pixels(1, size, GL_RGBA, GL_UNSIGNED_BYTE, CV_8UC4, pixels_);
      image.instances = instance_numbers(pixels_);
    }
    if (request.normals) read_pixels(2, size, GL_RGB, GL_FLOAT, CV_32FC3, image.normals);
    if (request.motion) read_pixels(3, size, GL_RGB, GL_FLOAT, CV_32FC3, image.motion);
    return image;
  }

  static cv::Mat read_depth(const PinholeCamera& camera) {
    cv::Mat depth;
    read_pixels(0, {camera.width, camera.height}, GL_DEPTH_COMPONENT, GL_FLOAT, CV_32FC1, depth);
    linearise(depth);
    return depth;
  }

  static void read_pixels(int attachment, const cv::Size& size, GLenum format, GLenum type,
                          int mat_type, cv::Mat& pixels) {
    pixels.create(size, mat_type);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, size.width, size.height, format, type, pixels.data);
  }

  RendererConfig config_;
  Light light_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Painter> painter_;
  std::map<std::tuple<int, int, bool>, GlTarget> targets_;  // by width, height, truth
  cv::Mat pixels_;                                          // RGB and label
};

Renderer::Renderer(const Scene& scene, const RendererConfig& config)
    : impl_(std::make_unique<Impl>(scene, config)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

RenderedImage Renderer::render(const PinholeCamera& camera, const Pose& T_world_cam,
                               const Request& request) {
  return impl_->render(camera, T_world_cam, request);
}

Renderer::Request truth_request(double time, double other_time) {
  Renderer::Request request;
  request.labels = request.depth = request.instances = request.normals = request.motion = true;
  request.time = time;
  request.other_time = other_time;
  return request;
}

}  // namespace vinebench::sim
