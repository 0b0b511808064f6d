// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/fake/fake_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/util/random.h"
#include "sim/render/camera_check.h"
#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr int kShades = 8;

/// What a ray meets first.
struct Hit {
  Label label = Label::kSky;
  double distance = 0;  ///< along a ray of z = 1 in the camera's frame: the depth, m
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< world frame, towards the camera
  Eigen::Vector2d place = Eigen::Vector2d::Zero();   ///< on the surface, m
  double square = 1;                                 ///< m
};

/// Where the ray from `at` leaves the court through a wall; infinite outside.
Hit wall_hit(const Eigen::Vector3d& at, const Eigen::Vector3d& ray) {
  Hit hit;
  hit.distance = std::numeric_limits<double>::infinity();
  if (at.head<2>().cwiseAbs().maxCoeff() >= FakeRenderer::kHalfWidth) return hit;
  for (int axis = 0; axis < 2; ++axis) {
    if (ray[axis] == 0) continue;
    const double side = ray[axis] > 0 ? 1 : -1;
    const double distance = (side * FakeRenderer::kHalfWidth - at[axis]) / ray[axis];
    if (distance >= hit.distance) continue;
    hit.distance = distance;
    hit.normal = -side * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d p = at + distance * ray;
    hit.place = {side * p[1 - axis], p.z()};
  }
  hit.label = Label::kPost;
  hit.square = FakeRenderer::kWallSquare;
  return hit;
}

Hit first_hit(const Eigen::Vector3d& at, const Eigen::Vector3d& ray) {
  const Hit wall = wall_hit(at, ray);
  const double ground = ray.z() < 0 && at.z() > 0 ? -at.z() / ray.z() : -1;
  if (ground > 0 && ground < wall.distance) {
    const Eigen::Vector3d p = at + ground * ray;
    return {Label::kGround, ground, Eigen::Vector3d::UnitZ(), p.head<2>(),
            FakeRenderer::kGroundSquare};
  }
  const double height = at.z() + wall.distance * ray.z();
  if (std::isfinite(wall.distance) && height >= 0 && height <= FakeRenderer::kWallHeight) {
    return wall;
  }
  return {};
}

/// The shade of a surface's square, 0 to kShades - 1; the sky has the brightest.
std::size_t shade_of(const RandomStream& pattern, const Hit& hit) {
  if (hit.label == Label::kSky) return kShades - 1;
  const auto cell = [&](double x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / hit.square)));
  };
  const auto surface = static_cast<std::uint64_t>(hit.label);
  const std::uint64_t square =
      (cell(hit.place.x()) & 0xffffff) << 24 | (cell(hit.place.y()) & 0xffffff);
  return pattern.bits(surface << 48 | square) % kShades;
}

/// Codes of shades from 5 % to 75 % of white.
std::array<std::uint8_t, kShades> codes_of_shades(double exposure) {
  std::array<std::uint8_t, kShades> codes{};
  for (std::size_t i = 0; i < kShades; ++i) {
    const double light = 0.05 + 0.1 * static_cast<double>(i);
    codes[i] = static_cast<std::uint8_t>(std::lround(code_of_light(exposure * light)));
  }
  return codes;
}

void allocate(const PinholeCamera& camera, const RenderRequest& request, RenderedImage& image) {
  const cv::Size size(camera.width, camera.height);
  image.rgb.create(size, CV_8UC3);
  if (request.labels) image.labels.create(size, CV_8UC1);
  if (request.depth) image.depth.create(size, CV_32FC1);
  if (request.instances) image.instances.create(size, CV_32SC1);
  if (request.normals) image.normals.create(size, CV_32FC3);
  if (request.motion) image.motion = cv::Mat::zeros(size, CV_32FC3);
}

}  // namespace

FakeRenderer::FakeRenderer(const Scene& scene)
    : instances_(static_cast<int>(scene.instances.size())) {}

RenderedImage FakeRenderer::render(const PinholeCamera& camera, const Pose& T_world_cam,
                                   const RenderRequest& request) {
  check_camera(camera);
  static const RandomStream pattern(1, "fake renderer");
  const std::array<std::uint8_t, kShades> codes = codes_of_shades(request.exposure);
  const Eigen::Matrix3d R_world_cam = T_world_cam.rotation.toRotationMatrix();
  RenderedImage image;
  allocate(camera, request, image);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
      const Hit hit = first_hit(T_world_cam.translation, R_world_cam * ray);
      const int instance = hit.label == Label::kGround ? 1 : hit.label == Label::kPost ? 2 : 0;
      image.rgb.at<cv::Vec3b>(y, x) = cv::Vec3b::all(codes[shade_of(pattern, hit)]);
      if (request.labels)
        image.labels.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(hit.label);
      if (request.depth) image.depth.at<float>(y, x) = static_cast<float>(hit.distance);
      if (request.instances) {
        image.instances.at<std::int32_t>(y, x) = instance <= instances_ ? 256 * instance : 0;
      }
      if (request.normals) {
        const Eigen::Vector3f normal = (R_world_cam.transpose() * hit.normal).cast<float>();
        image.normals.at<cv::Vec3f>(y, x) = {normal.x(), normal.y(), normal.z()};
      }
    }
  }
  return image;
}

}  // namespace vinebench::sim
