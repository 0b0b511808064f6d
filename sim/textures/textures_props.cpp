// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/textures/textures.h"
#include "sim/textures/textures_paint.h"

namespace vinebench::sim {
namespace {

constexpr int kPanel = 512;  // px, height of one half of a carton's image

/// A logo: a ring, a triangle or a block, with a line through it.
void print_mark(cv::Mat& panel, RandomSequence& random, const cv::Scalar& ink) {
  const cv::Point at(panel.cols / 4 + random.below(40), panel.rows / 3 + random.below(40));
  const int size = panel.rows / 6 + random.below(panel.rows / 12);
  const int kind = random.below(3);
  if (kind == 0) cv::circle(panel, at, size, ink, size / 4, cv::LINE_AA);
  if (kind == 1) {
    const std::vector<cv::Point> corners{
        {at.x - size, at.y + size}, {at.x + size, at.y + size}, {at.x, at.y - size}};
    cv::fillPoly(panel, std::vector<std::vector<cv::Point>>{corners}, ink, cv::LINE_AA);
  }
  if (kind == 2)
    cv::rectangle(panel, at - cv::Point(size, size), at + cv::Point(size, size), ink, -1);
  cv::line(panel, at - cv::Point(size, size / 3), at + cv::Point(size, -size / 3),
           cv::Scalar(246, 246, 246), size / 5, cv::LINE_AA);
}

/// Words as bars of varying length, like print at a distance.
void print_lines(cv::Mat& panel, RandomSequence& random, const cv::Rect& area, int lines,
                 const cv::Scalar& ink) {
  const int pitch = area.height / lines;
  for (int line = 0; line < lines; ++line) {
    const int tall = static_cast<int>(pitch * random.uniform(0.45, 0.6));
    for (int x = area.x; x < area.x + area.width;) {
      const int word = static_cast<int>(tall * random.uniform(0.8, 4.5));
      const int end = std::min(x + word, area.x + area.width);
      cv::rectangle(panel, {x, area.y + line * pitch}, {end, area.y + line * pitch + tall}, ink,
                    -1);
      for (int gap = x + tall / 2; gap < end; gap += std::max(3, tall / 2)) {
        cv::line(panel, {gap, area.y + line * pitch}, {gap, area.y + line * pitch + tall},
                 cv::Scalar(246, 246, 246), std::max(1, tall / 8));
      }
      x = end + tall;
      if (random.below(5) == 0) break;
    }
  }
}

void print_bar_code(cv::Mat& panel, RandomSequence& random, const cv::Rect& area) {
  cv::rectangle(panel, area, {250, 250, 250}, -1);
  for (int x = area.x + 6; x < area.x + area.width - 6;) {
    const int wide = 2 + random.below(5);
    cv::rectangle(panel, {x, area.y + 6}, {x + wide - 1, area.y + area.height - 6}, {30, 30, 30},
                  -1);
    x += wide + 2 + random.below(5);
  }
}

void print_panel(cv::Mat panel, RandomSequence& random, const cv::Scalar& ink) {
  const int w = panel.cols, h = panel.rows;
  print_mark(panel, random, ink);
  print_lines(panel, random, {w / 2, h / 8, 3 * w / 8, h / 4}, 2, ink);
  print_lines(panel, random, {w / 2, h / 2 - h / 16, 3 * w / 8, h / 4}, 5, {56, 52, 48});
  print_lines(panel, random, {w / 10, 3 * h / 4, w / 3, h / 8}, 3, {56, 52, 48});
  print_bar_code(panel, random, {5 * w / 8, 3 * h / 4 - h / 32, w / 4, h / 6});
  cv::rectangle(panel, {w / 24, h / 16}, {23 * w / 24, 15 * h / 16}, ink, 4);
}

}  // namespace

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
    rgb.row(y) *= wave;  // the flutes of the board, hardly visible
  }
  rgb(cv::Rect(112, 256, 32, 256)) *= 0.9;  // the tape over the seam
  return {"carton", to_rgba(rgb), false};
}

Texture print_texture(std::uint64_t seed) {
  const cv::Size size(kPanel, 2 * kPanel);
  cv::Mat rgb =
      blend(fractal_noise(size, {4, 8}, 3, 0.5, seed, "carton"), {238, 238, 238}, {251, 251, 251});
  RandomSequence random(RandomStream(seed, "print"));
  const std::array<cv::Scalar, 4> inks{
      cv::Scalar(168, 40, 34), {36, 62, 128}, {32, 96, 54}, {44, 40, 40}};
  for (const int half : {0, 1}) {
    const cv::Scalar& ink = inks.at(static_cast<std::size_t>(random.below(4)));
    print_panel(rgb(cv::Rect(0, half * kPanel, kPanel, kPanel)), random, ink);
  }
  return {"print", to_rgba(rgb), false};
}

Texture cloth_texture(std::uint64_t seed) {
  const cv::Mat folds = fractal_noise({128, 128}, {3, 3}, 4, 0.6, seed, "cloth");
  return {"cloth", to_rgba(blend(folds, {190, 190, 190}, {252, 252, 252})), true};
}

}  // namespace vinebench::sim
