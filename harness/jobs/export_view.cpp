// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/export_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/files/dataset_folder.h"
#include "sim/render/gl/sky.h"
#include "sim/render/image_encoding.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSkyReach = 1.4;  // of the sky's image (sky.h)
constexpr const char* kSkyFile = "sky.hdr";

double latitude(int row, int rows) {
  return (0.5 - (row + 0.5) / rows) * std::numbers::pi;
}

/// The texel of the sky's image in that direction; below its rim that of the rim.
cv::Vec3f sky_in(const cv::Mat& image, const Eigen::Vector3d& ray) {
  Eigen::Vector2d at = ray.head<2>() / std::max(0.05, 1 + ray.z());
  if (at.norm() > kSkyReach) at *= kSkyReach / at.norm();
  const auto texel = [](double share, int size) {
    return std::clamp(static_cast<int>((0.5 + 0.5 * share / kSkyReach) * size), 0, size - 1);
  };
  const auto& codes = image.at<cv::Vec4b>(texel(at.y(), image.rows), texel(at.x(), image.cols));
  cv::Vec3f light;
  for (int c = 0; c < 3; ++c) {
    // Of white and more: the image's codes end at that brightness.
    light[c] = static_cast<float>(sim::light_of_code(codes[c]) *
                                  std::pow(sim::kSkyBrightest, sim::kImageGamma));
  }
  return light;
}

std::array<float, 3> numbers(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

Json camera_json(const sim::ExportedView& view, const sim::Light& light, double exposure,
                 double lighting) {
  const PinholeCamera& camera = view.camera;
  Json json{{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
            {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
  const Eigen::Matrix4d T = view.T_world_cam.matrix();
  for (int i = 0; i < 16; ++i) json["T_world_cam"].push_back(T(i / 4, i % 4));
  json["exposure"] = exposure;
  json["sun"] = {{"towards", numbers(light.towards_sun)}, {"colour", numbers(light.sun)}};
  json["sky"] = {{"image", kSkyFile}, {"lighting", lighting}};
  return json;
}

void write_sky(const std::filesystem::path& file, const cv::Mat& panorama) {
  cv::Mat bgr;
  cv::cvtColor(panorama, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".hdr", bgr, bytes)) fail("{}: cannot be encoded", file.string());
  write_file_atomically(file, std::string(bytes.begin(), bytes.end()));
}

}  // namespace

cv::Mat sky_panorama(const sim::Light& light, std::uint64_t seed, cv::Size size) {
  const cv::Mat image = sim::sky_image(light, seed);
  cv::Mat panorama(size, CV_32FC3);
  for (int y = 0; y < size.height; ++y) {
    const double up = latitude(y, size.height);
    for (int x = 0; x < size.width; ++x) {
      const double round = (0.5 - (x + 0.5) / size.width) * 2 * std::numbers::pi;
      panorama.at<cv::Vec3f>(y, x) = sky_in(
          image, {std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up)});
    }
  }
  return panorama;
}

double light_from_above(const cv::Mat& panorama) {
  double sum = 0, weights = 0;
  for (int y = 0; y < panorama.rows / 2; ++y) {
    const double up = latitude(y, panorama.rows);
    const double weight = std::sin(up) * std::cos(up);  // of its height and of its row's length
    sum += weight * cv::mean(panorama.row(y))[1];
    weights += weight;
  }
  return sum / weights;
}

void export_view(const std::filesystem::path& folder, sim::Scene scene,
                 const sim::ExportedView& view, double exposure,
                 const std::optional<Pose>& T_world_rover) {
  make_folder(folder);
  std::vector<sim::PlacedMesh> placed = sim::meshes_in_reach(scene, view);
  sim::add_wires(scene, view, placed);
  if (T_world_rover) placed.push_back({scene.rover_model, 0, *T_world_rover, 1});
  write_file_atomically(folder / "scene.glb", sim::to_glb(scene, placed));
  const cv::Mat panorama = sky_panorama(scene.light, scene.seed, {1024, 512});
  write_sky(folder / kSkyFile, panorama);
  const double lighting = scene.light.sky.y() / std::max(1e-6, light_from_above(panorama));
  write_file_atomically(folder / "camera.json",
                        camera_json(view, scene.light, exposure, lighting).dump(2, ' ') + "\n");
}

}  // namespace vinebench::harness
