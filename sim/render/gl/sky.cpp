// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/util/random.h"
#include "sim/render/gl/scene/view_block.h"

namespace vinebench::sim {
namespace {

constexpr int kSize = 1024;     // pixels a side
constexpr double kReach = 1.4;  // of the parabolic map; the horizon is at 1
constexpr double kOvercastSeen = 0.9;
constexpr double kCloudSeen = 0.48;     // of what lights it
constexpr double kLowestCloud = 0.015;  // sine of the elevation

/// The byte that a light is encoded as. It is looked up, because a power takes as long as a dozen
/// of comparisons, but for lights so near to two bytes' limit that rounding decides.
class SkyBytes {
 public:
  SkyBytes() {
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      limits_[i] = std::pow((static_cast<double>(i) + 0.5) * kSkyBrightest / 255, 2.2);
    }
  }

  std::uint8_t of(double light) const {
    const auto above = std::upper_bound(limits_.begin(), limits_.end(), light);
    if (above != limits_.end() && is_near(*above, light)) return computed(light);
    if (above != limits_.begin() && is_near(*(above - 1), light)) return computed(light);
    return static_cast<std::uint8_t>(above - limits_.begin());
  }

 private:
  static bool is_near(double limit, double light) { return std::abs(limit - light) < 1e-9 * limit; }
  static std::uint8_t computed(double light) {
    return cv::saturate_cast<std::uint8_t>(255 / kSkyBrightest *
                                           std::pow(std::max(0.0, light), 1 / 2.2));
  }

  std::array<double, 255> limits_;  ///< the light from which on a byte is the next one
};

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Value noise on a lattice: smooth, 0 to 1.
double value_noise(const RandomStream& stream, double x, double y) {
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  const double tx = smooth_step(0, 1, x - fx);
  const double ty = smooth_step(0, 1, y - fy);
  const auto at = [&](double ix, double iy) {
    const auto column = static_cast<std::uint64_t>(static_cast<std::int64_t>(ix) + 4096);
    const auto row = static_cast<std::uint64_t>(static_cast<std::int64_t>(iy) + 4096);
    return stream.uniform(row * 8192 + column);
  };
  const double top = at(fx, fy) * (1 - tx) + at(fx + 1, fy) * tx;
  const double bottom = at(fx, fy + 1) * (1 - tx) + at(fx + 1, fy + 1) * tx;
  return top * (1 - ty) + bottom * ty;
}

/// A cloud layer seen from below, 0 to 1: what lies low is far, and its clouds crowd together.
double cloud_layer(const RandomStream& stream, const Eigen::Vector3d& ray) {
  constexpr std::array<double, 7> kHeights{0.44, 0.25, 0.14, 0.08, 0.05, 0.025, 0.015};
  if (ray.z() < kLowestCloud) return 0.5;
  Eigen::Vector2d p = 1.1 * ray.head<2>() / (ray.z() + 0.16);
  double shape = 0;
  for (std::size_t i = 0; i < kHeights.size(); ++i) {
    const double shift = 37.0 * static_cast<double>(i);
    shape += kHeights.at(i) * value_noise(stream, p.x() + shift, p.y() - 2 * shift);
    p *= 2.17;
  }
  return shape;
}

/// Around the sun, of whose direction `towards_sun` is the cosine.
double glow(double towards_sun) {
  if (towards_sun <= 0) return 0;
  // Below, the narrow part is less than the last digit of the wide one.
  const double narrow = towards_sun > 0.8 ? 0.6 * std::pow(towards_sun, 200) : 0;
  return 0.25 * std::pow(towards_sun, 12) + narrow;
}

/// Linear light from that direction of a clear sky with a few clouds.
Eigen::Vector3d clear_sky(const Light& light, const RandomStream& stream,
                          const Eigen::Vector3d& ray) {
  const Eigen::Vector3d sky = light.sky.cast<double>();
  const Eigen::Vector3d zenith = sky.cwiseProduct(Eigen::Vector3d(0.50, 0.75, 1.15));
  const Eigen::Vector3d horizon = sky.cwiseProduct(Eigen::Vector3d(1.55, 1.50, 1.35));
  Eigen::Vector3d c = horizon + (zenith - horizon) * std::sqrt(std::clamp(ray.z(), 0.0, 1.0));
  c += light.sun.cast<double>() * glow(ray.dot(light.towards_sun.cast<double>()));
  const Eigen::Vector3d white = 0.55 * light.sun.cast<double>() + 0.6 * sky;
  const double layer = cloud_layer(stream, ray);
  const double thick = smooth_step(0.40, 0.80, layer) * smooth_step(0.04, 0.30, ray.z());
  const double shaded = 1 - 0.2 * smooth_step(0.60, 0.85, layer);  // the undersides of thick ones
  return kSkySeen * c + (kCloudSeen * shaded * white - kSkySeen * c) * (0.75 * thick);
}

/// Linear light from that direction.
Eigen::Vector3d sky_light(const Light& light, const RandomStream& stream,
                          const Eigen::Vector3d& ray) {
  const Eigen::Vector3d land =
      light.haze > 0
          ? horizon_light(light).cast<double>().eval()
          : light.bounce.cast<double>().cwiseProduct(Eigen::Vector3d(0.8, 0.95, 0.8)).eval();
  const double above = smooth_step(-0.05, 0.015, ray.z());
  if (above == 0) return land;
  Eigen::Vector3d c = clear_sky(light, stream, ray);
  if (light.overcast > 0) {
    // Moon and Spencer's overcast sky, brighter towards the zenith, with the rolls of its clouds.
    const double height = std::clamp(ray.z(), 0.0, 1.0);
    const double rolls = 2 * cloud_layer(stream, ray) - 1;
    const double grey =
        (1 + 2 * height) / 2.2 * (1 + 0.32 * rolls * smooth_step(kLowestCloud, 0.12, ray.z()));
    c += light.overcast * (kOvercastSeen * grey * 1.1 * light.sky.cast<double>() - c);
  }
  if (light.haze > 0) {
    // The air thins upwards within about a kilometre.
    const double thickness = 1000 * static_cast<double>(light.haze) / std::max(0.02, ray.z());
    c += (land - c) * (1 - std::exp(-thickness));
  }
  return c + (land - c) * (1 - above);
}

}  // namespace

cv::Mat sky_image(const Light& light, std::uint64_t seed) {
  static const SkyBytes bytes;
  const RandomStream stream(seed, "renderer.clouds");
  cv::Mat image(kSize, kSize, CV_8UC4);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const Eigen::Vector2d p =
          kReach * (2 * Eigen::Vector2d(column + 0.5, row + 0.5) / kSize - Eigen::Vector2d::Ones());
      const double q = p.squaredNorm();
      const Eigen::Vector3d ray(2 * p.x() / (1 + q), 2 * p.y() / (1 + q), (1 - q) / (1 + q));
      const Eigen::Vector3d c = sky_light(light, stream, ray);
      cv::Vec4b& pixel = image.at<cv::Vec4b>(row, column);
      for (int i = 0; i < 3; ++i) pixel[i] = bytes.of(c[i]);
      pixel[3] = 255;
    }
  }
  return image;
}

}  // namespace vinebench::sim
