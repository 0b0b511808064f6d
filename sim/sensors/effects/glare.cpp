// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace vinebench::sim {
namespace {

constexpr double kGamma = 2.2;
constexpr double kDegree = 3.14159265358979 / 180;
constexpr double kDisc = 0.27 * kDegree;  // rad, the sun's radius

/// Linear light added at an angle (rad) from the sun, per unit of its light: the disc with its
/// bloom, a halo of scattering glass, and a veil. Shaped after the glare spread of a clean lens.
double spread(double angle) {
  constexpr double kBloom = 6;  // degrees; beyond, it is below the last bit of the halo
  const double degrees = angle / kDegree;
  const double bloom = degrees > kBloom ? 0 : 6.0 * std::exp(-degrees * degrees / (0.8 * 0.8));
  const double fifths = degrees / 5.0;
  const double halo = 0.22 / (1 + fifths * fifths);
  return bloom + halo + 0.02;
}

/// Share of the sun's disc (at least a few pixels of it) that shows sky.
double uncovered(const cv::Mat& labels, const PinholeCamera& camera, const Eigen::Vector2d& sun) {
  const int reach = std::max(2, static_cast<int>(std::ceil(kDisc * camera.fx)));
  const auto cx = static_cast<int>(std::lround(sun.x()));
  const auto cy = static_cast<int>(std::lround(sun.y()));
  int open = 0;
  int all = 0;
  for (int y = std::max(0, cy - reach); y <= std::min(labels.rows - 1, cy + reach); ++y) {
    for (int x = std::max(0, cx - reach); x <= std::min(labels.cols - 1, cx + reach); ++x) {
      ++all;
      if (labels.at<std::uint8_t>(y, x) == static_cast<std::uint8_t>(Label::kSky)) ++open;
    }
  }
  return all == 0 ? 0 : static_cast<double>(open) / all;
}

std::array<float, 256> decoding_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255, kGamma));
  }
  return table;
}

/// Light of 0 to 1 in equal steps of its square root, where the camera's and the table's steps are
/// about even, to a byte.
constexpr int kSteps = 4096;
std::array<std::uint8_t, kSteps + 1> encoding_table() {
  std::array<std::uint8_t, kSteps + 1> table{};
  for (int i = 0; i <= kSteps; ++i) {
    const double light = std::pow(static_cast<double>(i) / kSteps, 2);
    table[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255 * std::pow(light, 1 / kGamma)));
  }
  return table;
}

/// The sun's place where it is in the image.
std::optional<Eigen::Vector2d> sun_in(const PinholeCamera& camera,
                                      const Eigen::Vector3d& towards_sun, const Light& light) {
  if (light.glare <= 0 || light.sun.maxCoeff() <= 0 || towards_sun.z() <= 0.05) return {};
  const Eigen::Vector2d sun = camera.project(towards_sun);
  if (!camera.contains(sun)) return {};
  return sun;
}

Eigen::Vector3d towards_sun_of(const DrawnView& view, const Light& light) {
  return view.T_world_cam.rotation.inverse() * light.towards_sun.cast<double>();
}

class Glare : public ViewEffect {
 public:
  explicit Glare(const Light& light) : light_(light) {}
  bool wants_labels(const DrawnView& view) const override {
    return sun_in(view.camera, towards_sun_of(view, light_), light_).has_value();
  }
  void apply(RenderedImage& image, const DrawnView& view) const override {
    add_glare(image.rgb, image.labels, view.camera, towards_sun_of(view, light_), light_,
              view.exposure);
  }

 private:
  Light light_;
};

}  // namespace

void add_glare(cv::Mat& rgb, const cv::Mat& labels, const PinholeCamera& camera,
               const Eigen::Vector3d& towards_sun, const Light& light, double exposure) {
  const std::optional<Eigen::Vector2d> sun = sun_in(camera, towards_sun, light);
  if (!sun) return;
  const double strength =
      static_cast<double>(light.glare) * exposure * uncovered(labels, camera, *sun);
  if (strength <= 0) return;
  static const std::array<float, 256> decoded = decoding_table();
  static const std::array<std::uint8_t, kSteps + 1> encoded_byte = encoding_table();
  const Eigen::Vector3d direction = towards_sun.normalized();
  for (int y = 0; y < rgb.rows; ++y) {
    auto* row = rgb.ptr<cv::Vec3b>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
      const double angle = std::acos(std::clamp(ray.normalized().dot(direction), -1.0, 1.0));
      const auto added = static_cast<float>(strength * spread(angle));
      for (int c = 0; c < 3; ++c) {
        const float sum = std::min(1.0f, decoded[row[x][c]] + added * light.sun[c]);
        const double step = kSteps * std::sqrt(sum);  // rounded without a call
        row[x][c] = encoded_byte[static_cast<std::size_t>(step + 0.5)];
      }
    }
  }
}

std::unique_ptr<ViewEffect> make_glare(const EffectInputs& inputs) {
  if (inputs.light.glare <= 0 || inputs.light.sun.maxCoeff() <= 0) return nullptr;
  return std::make_unique<Glare>(inputs.light);
}

RenderedImage render_with_glare(RenderEngine& engine, const Light& light,
                                const PinholeCamera& camera, const Pose& T_world_cam,
                                const RenderRequest& request) {
  const Glare glare(light);
  const DrawnView view{camera, T_world_cam, request.exposure};
  RenderRequest labelled = request;
  labelled.labels |= glare.wants_labels(view);
  RenderedImage image = engine.render(camera, T_world_cam, labelled);
  glare.apply(image, view);
  if (!request.labels) image.labels.release();
  return image;
}

}  // namespace vinebench::sim
