// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/textures.h"

namespace vinebench {
namespace {

/// Draws a small thing on a picture that repeats: again wherever it crosses the seam.
template <class Draw>
void draw_wrapped(const cv::Mat& picture, const cv::Point2d& at, double reach, const Draw& draw) {
  for (const int ix : {-1, 0, 1}) {
    for (const int iy : {-1, 0, 1}) {
      const cv::Point2d p(at.x + ix * picture.cols, at.y + iy * picture.rows);
      if (p.x > -reach && p.y > -reach && p.x < picture.cols + reach &&
          p.y < picture.rows + reach) {
        draw(p);
      }
    }
  }
}

cv::Scalar jitter(RandomSequence& random, const cv::Vec3d& colour, double amount) {
  const double light = random.uniform(1 - amount, 1 + amount);
  return {colour[0] * light, colour[1] * light, colour[2] * light};
}

cv::Point2d somewhere(RandomSequence& random, const cv::Mat& picture) {
  const double x = random.uniform(0, picture.cols);
  return {x, random.uniform(0, picture.rows)};
}

/// Each stone with the shadow it throws and the light on its upper side.
void scatter_stones(cv::Mat& rgb, RandomSequence& random, int count, double min_px, double max_px) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double size = min_px * std::pow(max_px / min_px, std::pow(random.uniform(), 2.5));
    const cv::Size2d axes(size, size * random.uniform(0.55, 0.95));
    const double angle = random.uniform(0, 180);
    const cv::Scalar skin = jitter(random, {138, 126, 108}, 0.3);
    draw_wrapped(rgb, at, 2 * size, [&](const cv::Point2d& p) {
      const auto oval = [&](const cv::Point2d& shift, double scale, const cv::Scalar& colour) {
        cv::ellipse(
            rgb,
            cv::RotatedRect(p + shift, cv::Size2d(2 * scale * axes.width, 2 * scale * axes.height),
                            angle),
            colour, cv::FILLED, cv::LINE_AA);
      };
      oval({0.25 * size, 0.25 * size}, 1.1, {48, 38, 28});
      oval({0, 0}, 1.0, skin);
      oval({-0.2 * size, -0.2 * size}, 0.55, skin * 1.18);
    });
  }
}

/// Bits of straw and twigs.
void scatter_straws(cv::Mat& rgb, RandomSequence& random, int count, const cv::Vec3d& colour,
                    double length) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double reach = length * random.uniform(0.3, 1.0);
    const cv::Point2d along(reach * std::cos(angle), reach * std::sin(angle));
    const cv::Point2d bend(-along.y * random.uniform(-0.3, 0.3), along.x * 0.2);
    const cv::Scalar skin = jitter(random, colour, 0.3);
    const int width = random.below(3) == 0 ? 2 : 1;
    draw_wrapped(rgb, at, 2 * length, [&](const cv::Point2d& p) {
      cv::line(rgb, p, p + 0.5 * along + bend, skin, width, cv::LINE_AA);
      cv::line(rgb, p + 0.5 * along + bend, p + along, skin, width, cv::LINE_AA);
    });
  }
}

/// Fallen vine leaves: the outline of one, shrivelled and brown.
void scatter_leaves(cv::Mat& rgb, RandomSequence& random, int count, double size_px) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double size = size_px * random.uniform(0.5, 1.1);
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const double squeeze = random.uniform(0.5, 1.0);
    const cv::Scalar skin = jitter(random, {126, 88, 50}, 0.35);
    draw_wrapped(rgb, at, 2 * size, [&](const cv::Point2d& p) {
      std::vector<cv::Point> outline, shadow;
      for (const Eigen::Vector2f& o : leaf_outline(2)) {
        const double x = o.x() * squeeze, y = o.y();
        const cv::Point2d q(p.x + size * (std::cos(turn) * x - std::sin(turn) * y),
                            p.y + size * (std::sin(turn) * x + std::cos(turn) * y));
        outline.push_back(q);
        shadow.push_back(q + cv::Point2d(0.08 * size, 0.08 * size));
      }
      const cv::Point tip(cvRound(p.x - size * 0.9 * std::sin(turn)),
                          cvRound(p.y + size * 0.9 * std::cos(turn)));
      cv::fillPoly(rgb, std::vector<std::vector<cv::Point>>{shadow}, {44, 34, 26}, cv::LINE_AA);
      cv::fillPoly(rgb, std::vector<std::vector<cv::Point>>{outline}, skin, cv::LINE_AA);
      cv::line(rgb, p, tip, skin * 0.6, 2, cv::LINE_AA);
    });
  }
}

}  // namespace

Texture soil_texture(std::uint64_t seed) {
  const cv::Size size(2048, 2048);
  const cv::Mat clods = fractal_noise(size, {24, 24}, 7, 0.72, seed, "clods");
  const cv::Mat damp = fractal_noise(size, {3, 3}, 4, 0.55, seed, "damp");
  cv::Mat rgb = mix(damp, blend(clods, {56, 40, 28}, {164, 132, 98}),
                    blend(clods, {74, 56, 38}, {192, 164, 128}));
  RandomSequence random(RandomStream(seed, "soil"));
  scatter_straws(rgb, random, 500, {150, 130, 88}, 60);
  scatter_stones(rgb, random, 1800, 3, 34);
  scatter_leaves(rgb, random, 30, 50);
  scatter_straws(rgb, random, 350, {84, 104, 46}, 40);
  return {"soil", to_rgba(rgb), true};
}

Texture wood_texture(std::uint64_t seed) {
  const cv::Size size(256, 512);
  const cv::Mat grain = fractal_noise(size, {32, 2}, 4, 0.65, seed, "grain");
  const cv::Mat stains = fractal_noise(size, {3, 3}, 5, 0.6, seed, "stains");
  cv::Mat rgb = mix(stains, blend(grain, {72, 62, 50}, {150, 134, 112}),
                    blend(grain, {88, 82, 72}, {176, 168, 152}));
  RandomSequence random(RandomStream(seed, "cracks"));
  for (int i = 0; i < 26; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const cv::Point2d down(random.uniform(-3, 3), random.uniform(30, 140));
    draw_wrapped(rgb, at, 150, [&](const cv::Point2d& p) {
      cv::line(rgb, p, p + down, {46, 38, 30}, 1 + i % 2, cv::LINE_AA);
    });
  }
  for (int i = 0; i < 7; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    draw_wrapped(rgb, at, 30, [&](const cv::Point2d& p) {
      cv::ellipse(rgb, cv::RotatedRect(p, {14, 22}, 0), {66, 50, 36}, cv::FILLED, cv::LINE_AA);
    });
  }
  return {"wood", to_rgba(rgb), true};
}

Texture carton_texture(std::uint64_t seed) {
  const cv::Size size(256, 512);
  cv::Mat rgb =
      blend(fractal_noise(size, {4, 8}, 3, 0.5, seed, "carton"), {241, 241, 241}, {251, 251, 251});
  for (int y = 0; y < size.height; ++y) {
    const float wave = 1 + 0.006f * std::sin(static_cast<float>(y) * std::numbers::pi_v<float> / 4);
    rgb.row(y) *= wave;  // the flutes of the board, hardly seen
  }
  rgb(cv::Rect(112, 256, 32, 256)) *= 0.9;  // the tape over the seam
  return {"carton", to_rgba(rgb), false};
}

Texture grass_texture(std::uint64_t seed) {
  const cv::Mat streaks = fractal_noise({64, 64}, {8, 2}, 3, 0.6, seed, "grass");
  return {"grass", to_rgba(blend(streaks, {62, 84, 28}, {142, 154, 72})), true};
}

Texture stone_texture(std::uint64_t seed) {
  const cv::Mat grain = fractal_noise({128, 128}, {4, 4}, 5, 0.75, seed, "stone");
  return {"stone", to_rgba(blend(grain, {84, 78, 68}, {186, 176, 158})), true};
}

Texture hedge_texture(std::uint64_t seed) {
  const cv::Size size(2048, 256);
  const cv::Mat leaves = fractal_noise(size, {64, 12}, 5, 0.8, seed, "hedge leaves");
  const cv::Mat crowns = fractal_noise(size, {24, 3}, 3, 0.6, seed, "hedge crowns");
  const cv::Mat shade = 0.55 * leaves + 0.45 * crowns;
  const cv::Mat rgb = blend(shade, {22, 34, 18}, {118, 136, 74});
  const cv::Mat skyline = fractal_noise({size.width, 16}, {20, 1}, 5, 0.6, seed, "skyline").row(8);
  cv::Mat alpha(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float top = 0.15f + 0.6f * skyline.at<float>(0, x) + 0.12f * leaves.at<float>(y, x);
      alpha.at<uchar>(y, x) =
          static_cast<float>(size.height - y) / size.height < 1.0f - top ? 255 : 0;
    }
  }
  return {"hedge", to_rgba(rgb, alpha), true};
}

}  // namespace vinebench
