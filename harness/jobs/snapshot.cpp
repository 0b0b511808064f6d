// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/snapshot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/geometry/angle.h"
#include "core/geometry/rig.h"
#include "core/util/error.h"
#include "harness/datasets/labels/label_table.h"
#include "sim/render/factory/make_render_engine.h"
#include "sim/sensors/camera/exposure.h"
#include "sim/sensors/effects/glare.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

std::vector<double> parse_numbers(const std::string& text, const std::string& expected) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, comma - at);
    char* end = nullptr;
    numbers.push_back(std::strtod(part.c_str(), &end));
    if (part.empty() || *end != '\0' || !std::isfinite(numbers.back())) {
      fail("'{}': expected {}", text, expected);
    }
    at = comma + 1;
  }
  return numbers;
}

}  // namespace

PinholeCamera parse_camera(const std::string& text) {
  PinholeCamera camera;
  int read = 0;
  const int fields =
      std::sscanf(text.c_str(), "%dx%d@%lf%n", &camera.width, &camera.height, &camera.fx, &read);
  if (fields != 3 || read != static_cast<int>(text.size()) || camera.width < 1 ||
      camera.height < 1 || !(camera.fx > 0) || !std::isfinite(camera.fx)) {
    fail("camera '{}': expected WIDTHxHEIGHT@FOCAL in pixels, such as 752x480@263.3", text);
  }
  camera.fy = camera.fx;
  camera.cx = (camera.width - 1) / 2.0;
  camera.cy = (camera.height - 1) / 2.0;
  return camera;
}

Pose parse_view(const std::string& text) {
  const std::string expected = "X,Y,Z,YAW or X,Y,Z,YAW,PITCH in metres and degrees";
  const std::vector<double> n = parse_numbers(text, "a pose " + expected);
  if (n.size() != 4 && n.size() != 5) fail("'{}': expected a pose {}", text, expected);
  const double pitch_up = n.size() == 5 ? n[4] : 0;
  return {from_roll_pitch_yaw({0, -pitch_up * kRadiansPerDegree, n[3] * kRadiansPerDegree}),
          {n[0], n[1], n[2]}};
}

cv::Mat colour_labels(const cv::Mat& labels) {
  cv::Mat colours(labels.size(), CV_8UC3);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      colours.at<cv::Vec3b>(y, x) = label_colour(labels.at<std::uint8_t>(y, x));
    }
  }
  return colours;
}

double metered_exposure(sim::RenderEngine& renderer, const sim::Light& light,
                        const PinholeCamera& camera, const Pose& T_world_cam,
                        const std::optional<Pose>& T_world_rover) {
  return sim::metered_factor([&](double factor) {
    sim::RenderRequest request;
    request.exposure = factor;
    request.T_world_rover = T_world_rover;
    return sim::render_with_glare(renderer, light, camera, T_world_cam, request).rgb;
  });
}

cv::Mat turntable(const sim::WorldConfig& world, std::uint64_t seed, const PinholeCamera& camera,
                  const sim::RendererConfig& config, const CacheFolder& plant_cache) {
  constexpr int kViews = 8;
  constexpr int kColumns = 4;
  constexpr double kPitchDown = 22 * kRadiansPerDegree;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& post : sim::lay_out(world).post_feet()) box.extend(post);
  const double distance = 1.5 + 0.75 * box.diagonal().norm();
  const sim::Scene scene = sim::build_scene(world, seed, plant_cache);
  const auto renderer = sim::make_render_engine(scene, config);
  sim::RenderRequest request;
  cv::Mat sheet(camera.height * (kViews / kColumns), camera.width * kColumns, CV_8UC3);
  for (int i = 0; i < kViews; ++i) {
    const double yaw = (i + 0.5) * 2 * std::numbers::pi / kViews;
    const Eigen::Vector2d viewpoint =
        box.center() - distance * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    const Pose T_world_cam =
        Rig::mount({viewpoint.x(), viewpoint.y(), 0.5 + distance * std::tan(kPitchDown)},
                   {0, kPitchDown, yaw});
    const cv::Rect place((i % kColumns) * camera.width, (i / kColumns) * camera.height,
                         camera.width, camera.height);
    if (i == 0) {
      request.exposure =
          metered_exposure(*renderer, scene.light, camera, T_world_cam, std::nullopt);
    }
    sim::render_with_glare(*renderer, scene.light, camera, T_world_cam, request)
        .rgb.copyTo(sheet(place));
  }
  return sheet;
}

}  // namespace vinebench::harness
