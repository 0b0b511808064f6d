// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/textures/textures.h"
#include "sim/textures/textures_paint.h"

namespace vinebench::sim {
namespace {

constexpr int kHedgeWidth = 4096, kHedgeHeight = 512;   // px
constexpr double kAcross = kHedgeWidth / kHedgeLength;  // px per m
constexpr double kUp = kHedgeHeight / (kHedgeTop / (1 - 2 * kWallInset));

/// What stands at the edge of the fields, painted from the back to the front.
class HedgePainter {
 public:
  HedgePainter(std::uint64_t seed, double withered)
      : random_(RandomStream(seed, "hedge things")),
        seed_(seed),
        withered_(withered),
        rgb_(kHedgeHeight, kHedgeWidth, CV_32FC3, cv::Scalar(92, 88, 78)),
        alpha_(kHedgeHeight, kHedgeWidth, CV_8UC1, cv::Scalar(0)) {}

  Texture paint() {
    const bool bare = withered_ > 0.3;
    bushes(3.4, 0.35, "far bushes");
    for (int i = 0; i < 3; ++i) building();
    for (int i = 0; i < 5; ++i) pole(random_.uniform(6.0, 8.5));
    for (int i = 0; i < 46; ++i) {
      const double x = random_.uniform(0, kHedgeLength), top = random_.uniform(3.0, 9.0);
      const bool leafless = random_.uniform() < (bare ? 0.78 : 0.03);
      if (leafless) {
        bare_tree(x, top);
      } else {
        crown(x, top);
      }
    }
    bushes(1.7, 1.0, "near bushes");
    return {"hedge", to_rgba(rgb_, alpha_), true};
  }

 private:
  static cv::Point2d at(double x, double z) {
    return {x * kAcross, kHedgeHeight * (1 - kWallInset) - z * kUp};
  }

  /// Draws on both images, repeated where it crosses the border.
  template <class Draw>
  void put(const cv::Scalar& colour, const Draw& draw) {
    for (const int wrap : {-1, 0, 1}) {
      const cv::Point2d shift(wrap * kHedgeWidth, 0);
      draw(rgb_, shift, colour);
      draw(alpha_, shift, cv::Scalar(255));
    }
  }

  void box(double x0, double z0, double x1, double z1, const cv::Scalar& colour) {
    put(colour, [&](cv::Mat& image, const cv::Point2d& shift, const cv::Scalar& c) {
      cv::rectangle(image, cv::Point(at(x0, z1) + shift), cv::Point(at(x1, z0) + shift), c, -1);
    });
  }

  void stroke(const cv::Point2d& from, const cv::Point2d& to, double width,
              const cv::Scalar& colour) {
    put(colour, [&](cv::Mat& image, const cv::Point2d& shift, const cv::Scalar& c) {
      cv::line(image, from + shift, to + shift, c, std::max(1, cvRound(width)), cv::LINE_8);
    });
  }

  /// An opaque band with a ragged top about `top` m high; `light` of its leaves.
  void bushes(double top, double light, const char* name) {
    const cv::Size size(kHedgeWidth, kHedgeHeight);
    const cv::Mat leaves = fractal_noise(size, {256, 32}, 4, 0.85, seed_, name);
    const cv::Mat crowns = fractal_noise(size, {96, 12}, 3, 0.7, seed_, "hedge crowns");
    const cv::Mat skyline =
        fractal_noise({kHedgeWidth, 16}, {64, 1}, 6, 0.7, seed_, "skyline").row(8);
    cv::Mat shade = 0.5 * leaves + 0.5 * crowns;
    shade = cv::min(cv::max(2.2 * (shade - 0.5) + 0.5, 0.0), 1.0);
    cv::Mat band = blend(shade, light * cv::Vec3f(20, 30, 15), cv::Vec3f(140, 158, 88));
    wither(band, withered_, seed_, name);
    for (int y = 0; y < kHedgeHeight; ++y) {
      const double z = (kHedgeHeight * (1 - kWallInset) - y) / kUp;
      for (int x = 0; x < kHedgeWidth; ++x) {
        const double ragged = 0.25 + 0.95 * static_cast<double>(skyline.at<float>(0, x)) +
                              0.35 * (static_cast<double>(leaves.at<float>(y, x)) - 0.5);
        if (z > top * ragged) continue;
        rgb_.at<cv::Vec3f>(y, x) = band.at<cv::Vec3f>(y, x);
        alpha_.at<uchar>(y, x) = 255;
      }
    }
  }

  void building() {
    const double x = random_.uniform(0, kHedgeLength), wide = random_.uniform(7.0, 14.0);
    const double eaves = random_.uniform(3.0, 4.5), ridge = eaves + random_.uniform(1.5, 2.6);
    const cv::Scalar wall = jitter(random_, {196, 184, 162}, 0.15);
    box(x, 0, x + wide, eaves, wall);
    const int windows = 3 + random_.below(3);
    for (int i = 0; i < windows; ++i) {
      const double left = x + wide * (i + 0.3) / windows;
      box(left, 1.0, left + 0.9, 2.3, {44, 46, 52});
    }
    const cv::Scalar tiles = jitter(random_, {134, 82, 62}, 0.2);
    const double hip = random_.uniform(0.3, 1.6);
    put(tiles, [&](cv::Mat& image, const cv::Point2d& shift, const cv::Scalar& c) {
      std::vector<cv::Point> roof;
      for (const cv::Point2d& p : {at(x - 0.5, eaves), at(x + hip, ridge),
                                   at(x + wide - hip, ridge), at(x + wide + 0.5, eaves)}) {
        roof.emplace_back(p + shift);
      }
      cv::fillPoly(image, std::vector<std::vector<cv::Point>>{roof}, c);
    });
    box(x + 0.6 * wide, ridge - 0.4, x + 0.6 * wide + 0.6, ridge + 0.7, wall * 0.7);
  }

  void pole(double top) {
    const double x = random_.uniform(0, kHedgeLength);
    const cv::Scalar grey = jitter(random_, {98, 92, 84}, 0.2);
    box(x - 0.11, 0, x + 0.11, top, grey);
    box(x - 0.8, top - 0.7, x + 0.8, top - 0.55, grey);
  }

  void bare_tree(double x, double top) {
    const cv::Scalar bark = jitter(random_, {84, 74, 64}, 0.35);
    const double width = 0.045 * top * kAcross;
    branch(at(x, -0.1), std::numbers::pi / 2 + random_.uniform(-0.06, 0.06), 0.30 * top * kUp,
           width, 7, bark);
  }

  /// Angle from the right, anticlockwise.
  void branch(const cv::Point2d& from, double angle, double length, double width, int left,
              const cv::Scalar& bark) {
    const cv::Point2d to(from.x + length * std::cos(angle), from.y - length * std::sin(angle));
    stroke(from, to, width, bark * random_.uniform(0.8, 1.2));
    if (left == 0) return;
    const int forks = left > 4 ? 2 + random_.below(2) : 2;
    for (int i = 0; i < forks; ++i) {
      const double spread = forks == 2 ? i - 0.5 : 0.6 * (i - 1);
      const double rise = 0.12 * (std::numbers::pi / 2 - angle);
      branch(to, angle + rise + 0.95 * spread + random_.uniform(-0.28, 0.28),
             length * random_.uniform(0.62, 0.86), 0.64 * width, left - 1, bark);
    }
  }

  /// A tree in leaf: clumps of leaves, lit from above on the left.
  void crown(double x, double top) {
    const double dull = 0.75 * std::min(1.0, withered_);  // what is green in winter is a conifer
    const cv::Vec3d leaf(random_.uniform(58, 108), random_.uniform(84, 122),
                         random_.uniform(34, 58));
    const cv::Vec3d green = leaf + dull * (cv::Vec3d(46, 60, 44) - leaf);
    const bool slender = random_.below(4) == 0;
    const double half = top * (slender ? 0.13 : random_.uniform(0.28, 0.42));
    const double middle = top * (slender ? 0.5 : 0.62), tall = top - middle;
    box(x - 0.12, 0, x + 0.12, middle, {58, 50, 42});
    const int clumps = cvRound(46 * half * tall);
    for (int i = 0; i < clumps; ++i) {
      const double turn = random_.uniform(0, 2 * std::numbers::pi);
      const double out = std::sqrt(random_.uniform()) * 0.92;
      const double dx = out * std::cos(turn), dz = out * std::sin(turn);
      const double size = random_.uniform(0.12, 0.42);
      const double lit = 0.95 + 0.36 * dz - 0.18 * dx + random_.uniform(-0.38, 0.38);
      const cv::Vec3d skin = std::max(0.16, lit) * green;
      const cv::Point2d p = at(x + half * dx, middle + tall * dz);
      put({skin[0], skin[1], skin[2]}, [&](cv::Mat& image, const cv::Point2d& shift,
                                           const cv::Scalar& c) {
        cv::ellipse(image, cv::Point(p + shift),
                    cv::Size(cvRound(size * kAcross), cvRound(0.7 * size * kUp)), 0, 0, 360, c, -1);
      });
    }
  }

  RandomSequence random_;
  std::uint64_t seed_;
  double withered_;
  cv::Mat rgb_, alpha_;
};

/// Farms and villages on far slopes.
void scatter_houses(cv::Mat& rgb, RandomSequence& random, int count) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at(random.uniform(0, rgb.cols),
                         rgb.rows * (1 - 0.7 * std::sqrt(random.uniform())));
    const cv::Size size(6 + random.below(9), 4 + random.below(4));
    const cv::Scalar wall = jitter(random, {196, 186, 166}, 0.2);
    const cv::Scalar roof = jitter(random, {138, 96, 78}, 0.2);
    draw_wrapped(rgb, at, 20, [&](const cv::Point2d& p) {
      cv::rectangle(rgb, cv::Rect(cv::Point(p), size), wall, -1);
      cv::rectangle(rgb, cv::Rect(cv::Point(p) - cv::Point(1, 3), cv::Size(size.width + 2, 4)),
                    roof, -1);
    });
  }
}

}  // namespace

Texture woods_texture(std::uint64_t seed, double withered) {
  const cv::Size size(2048, 256);
  const cv::Mat crowns = fractal_noise(size, {160, 40}, 4, 0.8, seed, "woods crowns");
  const cv::Mat stands = fractal_noise(size, {40, 10}, 4, 0.7, seed, "woods stands");
  const cv::Mat fields = fractal_noise(size, {14, 6}, 3, 0.6, seed, "woods fields");
  const cv::Mat woods = cv::min(cv::max(9 * (fields - 0.5) + 0.5, 0.0), 1.0);
  cv::Mat shade = 0.6 * crowns + 0.4 * stands;
  shade = cv::min(cv::max(2.0 * (shade - 0.5) + 0.5, 0.0), 1.0);
  cv::Mat rgb = mix(woods, blend(stands, {84, 104, 66}, {170, 168, 122}),
                    blend(shade, {20, 34, 26}, {128, 138, 98}));
  wither(rgb, withered, seed, "woods dry");
  RandomSequence random(RandomStream(seed, "woods houses"));
  scatter_houses(rgb, random, 60);
  const cv::Mat air(size, CV_32FC3, cv::Scalar(136, 150, 160));
  return {"woods", to_rgba(0.76 * rgb + 0.24 * air), true};
}

Texture hedge_texture(std::uint64_t seed, double withered) {
  return HedgePainter(seed, withered).paint();
}

}  // namespace vinebench::sim
