// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/supersampled_engine.h"

#include <array>
#include <cstdint>
#include <utility>

#include "sim/render/camera_check.h"
#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

bool wants_truth(const RenderRequest& request) {
  return request.labels || request.depth || request.instances || request.normals || request.motion;
}

/// The colours alone. A longer focal length would choose finer levels of detail than the truth has.
RenderRequest colours_of(const RenderRequest& request, int factor) {
  RenderRequest colours = request;
  colours.labels = colours.depth = colours.instances = colours.normals = colours.motion = false;
  colours.detail = request.detail / factor;
  return colours;
}

/// Light of each code, as a share of the mean.
std::array<float, 256> shares_of_mean(int factor) {
  std::array<float, 256> shares{};
  for (std::size_t code = 0; code < shares.size(); ++code) {
    shares[code] = static_cast<float>(light_of_code(static_cast<double>(code)) / (factor * factor));
  }
  return shares;
}

}  // namespace

/// The image covers [-0.5, width - 0.5): a pixel x is at factor * (x + 0.5) - 0.5.
PinholeCamera enlarged(const PinholeCamera& camera, int factor) {
  PinholeCamera large = camera;
  large.width *= factor;
  large.height *= factor;
  large.fx *= factor;
  large.fy *= factor;
  large.cx = factor * (camera.cx + 0.5) - 0.5;
  large.cy = factor * (camera.cy + 0.5) - 0.5;
  return large;
}

cv::Mat mean_of_squares(const cv::Mat& codes, int factor) {
  const std::array<float, 256> share = shares_of_mean(factor);
  cv::Mat light = cv::Mat::zeros(codes.rows / factor, codes.cols / factor, CV_32FC3);
  for (int y = 0; y < factor * light.rows; ++y) {
    const auto* from = codes.ptr<std::uint8_t>(y);
    auto* to = light.ptr<float>(y / factor);
    for (int x = 0; x < light.cols; ++x, to += 3) {
      for (int i = 0; i < factor; ++i, from += 3) {
        for (int c = 0; c < 3; ++c) to[c] += share[from[c]];
      }
    }
  }
  return to_codes(light);
}

SupersampledEngine::SupersampledEngine(std::unique_ptr<RenderEngine> engine, int factor)
    : engine_(std::move(engine)), factor_(factor) {}

RenderedImage SupersampledEngine::render(const PinholeCamera& camera, const Pose& T_world_cam,
                                         const RenderRequest& request) {
  check_camera(camera);
  RenderedImage image;
  if (wants_truth(request)) image = engine_->render(camera, T_world_cam, request);
  const RenderedImage large =
      engine_->render(enlarged(camera, factor_), T_world_cam, colours_of(request, factor_));
  image.rgb = mean_of_squares(large.rgb, factor_);
  return image;
}

}  // namespace vinebench::sim
