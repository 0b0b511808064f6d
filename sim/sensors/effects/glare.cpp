// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glare.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;
constexpr double kDisc = 0.27 * kDegree;  // rad, the sun's radius

// Shaped after the glare spread of a clean lens.
constexpr double kHalo = 0.22;      // in the middle
constexpr double kHaloDegrees = 5;  // where it is half of that
constexpr double kVeil = 0.02;

/// Linear light added at an angle (rad) from the sun, per unit of its light: the disc with its
/// bloom, a halo of scattering glass, and a veil.
double spread(double angle) {
  constexpr double kBloom = 6;  // degrees; beyond, it is below the last bit of the halo
  const double degrees = angle / kDegree;
  const double bloom = degrees > kBloom ? 0 : 6.0 * std::exp(-degrees * degrees / (0.8 * 0.8));
  const double widths = degrees / kHaloDegrees;
  const double halo = kHalo / (1 + widths * widths);
  return bloom + halo + kVeil;
}

/// The light that `strength` of the sun, in the direction of a unit vector, adds along a ray.
float spread_along(const Eigen::Vector3d& ray, const Eigen::Vector3d& sun, double strength) {
  const double angle = std::acos(std::clamp(ray.normalized().dot(sun), -1.0, 1.0));
  return static_cast<float>(strength * spread(angle));
}

/// Square of the angle, rad, whose cosine is 1 - u, by cubics in u: a tenth of the arc cosine's
/// time. Errors are below 2e-12 of the square from kLeast to kMost.
class SquaredAngles {
 public:
  SquaredAngles() {
    for (std::size_t i = 0; i < cubics_.size(); ++i) {
      // Newton's differences at four places of the cell, in thirds of its length.
      const double first = static_cast<double>(i) / kCells;
      std::array<double, 4> f;
      for (std::size_t k = 0; k < 4; ++k) {
        const double angle = std::acos(1 - (first + static_cast<double>(k) / (3 * kCells)));
        f[k] = angle * angle;
      }
      const double once = f[1] - f[0];
      const double twice = (f[2] - 2 * f[1] + f[0]) / 2;
      const double thrice = (f[3] - 3 * f[2] + 3 * f[1] - f[0]) / 6;
      cubics_[i] = {f[0], once - twice + 2 * thrice, twice - 3 * thrice, thrice};
    }
  }
  bool covers(double u) const { return u >= kLeast && u < kMost; }
  /// Any number where `u` is not covered.
  double operator()(double u) const {
    const double cell = std::clamp(u, kLeast, kMost) * kCells;
    const auto i = static_cast<std::size_t>(cell);
    const double t = 3 * (cell - static_cast<double>(i));
    const auto& c = cubics_[i];
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }

 private:
  static constexpr double kLeast = 0.0056;  ///< 6.06 degrees
  static constexpr double kMost = 1.5;
  static constexpr int kCells = 512;  // of 1
  std::array<std::array<double, 4>, static_cast<std::size_t>(kMost* kCells) + 1> cubics_;
};

/// The light along each ray of a row of pixels, the same floats as spread_along gives, mostly
/// without an arc cosine: beyond the bloom, where the halo's error cannot change how it is rounded.
/// `rays_x` and `ray_y` are at a depth of 1.
void spread_along_row(const Eigen::ArrayXd& rays_x, double ray_y, const Eigen::Vector3d& sun,
                      double strength, std::vector<float>& lights) {
  static const SquaredAngles squared_angle;
  constexpr double kPerWidth = 1 / (kHaloDegrees * kHaloDegrees * kDegree * kDegree);
  constexpr double kError = 1e-10;
  const Eigen::ArrayXd u = 1 - (rays_x * sun.x() + (ray_y * sun.y() + sun.z())) /
                                   (rays_x.square() + (ray_y * ray_y + 1)).sqrt();
  const Eigen::ArrayXd squares = u.unaryExpr([](double value) { return squared_angle(value); });
  const Eigen::ArrayXd light = strength * (kHalo / (1 + kPerWidth * squares) + kVeil);
  const Eigen::ArrayXf low = (light * (1 - kError)).cast<float>();
  const Eigen::ArrayXf high = (light * (1 + kError)).cast<float>();
  for (Eigen::Index x = 0; x < rays_x.size(); ++x) {
    const bool sure = squared_angle.covers(u[x]) && low[x] == high[x];
    lights[static_cast<std::size_t>(x)] =
        sure ? low[x] : spread_along({rays_x[x], ray_y, 1}, sun, strength);
  }
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
    table[i] = static_cast<float>(light_of_code(static_cast<double>(i)));
  }
  return table;
}

/// The byte of a light: rounded to equal steps of its square root, where the camera's steps are
/// about even, and encoded.
std::uint8_t encoded(float light) {
  constexpr int kSteps = 4096;
  const double root = std::floor(kSteps * std::sqrt(light) + 0.5) / kSteps;
  return static_cast<std::uint8_t>(std::lround(code_of_light(root * root)));
}

/// `encoded` from a table over the first bits of the float: a cell's lights differ by less than a
/// byte's step, so that the next byte begins at most once in it.
class Encoder {
 public:
  Encoder() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(kFirst + i) << kRest;
      // Bisection between the cell's first float and the next cell's.
      std::uint32_t low = first;
      std::uint32_t high = first + (1U << kRest);
      const std::uint8_t byte = byte_of(first);
      while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (byte_of(middle) == byte ? low : high) = middle;
      }
      cells_[i] = {std::bit_cast<float>(high), byte};
    }
  }
  /// Of a light from 0 to 1.
  std::uint8_t operator()(float light) const {
    const std::uint32_t cell = std::bit_cast<std::uint32_t>(light) >> kRest;
    if (cell < kFirst) return 0;
    const Cell& found = cells_[cell - kFirst];
    return static_cast<std::uint8_t>(found.byte + (light >= found.next ? 1 : 0));
  }

 private:
  struct Cell {
    float next;  ///< the first light of the next byte
    std::uint8_t byte;
  };
  static std::uint8_t byte_of(std::uint32_t bits) { return encoded(std::bit_cast<float>(bits)); }
  static constexpr int kRest = 15;  ///< bits of a float behind sign, exponent and eight more
  static constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(0x1p-20F) >> kRest;
  static constexpr std::uint32_t kLast = std::bit_cast<std::uint32_t>(1.0F) >> kRest;
  std::array<Cell, kLast - kFirst + 1> cells_;
};

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
  static const Encoder encode;
  const Eigen::Vector3d direction = towards_sun.normalized();
  const Eigen::ArrayXd rays_x =
      (Eigen::ArrayXd::LinSpaced(rgb.cols, 0, rgb.cols - 1) - camera.cx) / camera.fx;
  std::vector<float> lights(static_cast<std::size_t>(rgb.cols));
  for (int y = 0; y < rgb.rows; ++y) {
    spread_along_row(rays_x, (y - camera.cy) / camera.fy, direction, strength, lights);
    auto* row = rgb.ptr<cv::Vec3b>(y);
    for (std::size_t x = 0; x < lights.size(); ++x) {
      for (int c = 0; c < 3; ++c) {
        row[x][c] = encode(std::min(1.0f, decoded[row[x][c]] + lights[x] * light.sun[c]));
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
