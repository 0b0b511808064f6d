// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"
#include "sim/textures/textures_paint.h"

namespace vinebench::sim {
namespace {

/// Nearest pixel, with wrap-around.
float value_at(const cv::Mat& share, const cv::Point2d& at) {
  const cv::Point nearest = at;
  return share.at<float>(nearest.y % share.rows, nearest.x % share.cols);
}

/// Stones with their shadows and the light on their upper sides.
void scatter_stones(cv::Mat& rgb, RandomSequence& random, int count, double min_px, double max_px,
                    const cv::Mat* share = nullptr) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    if (share && value_at(*share, at) < 0.5f) continue;
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

/// Fallen vine leaves: shrivelled and brown.
void scatter_leaves(cv::Mat& rgb, RandomSequence& random, int count, double size_px) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double size = size_px * random.uniform(0.5, 1.1);
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const double squeeze = random.uniform(0.5, 1.0);
    const cv::Scalar skin = jitter(random, {122, 92, 60}, 0.35);
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

/// Fine noise, tiled to the size of the image.
cv::Mat repeated_noise(cv::Size size, cv::Size pieces, cv::Size cells, int octaves, double gain,
                       std::uint64_t seed, std::string_view name) {
  const cv::Size piece(size.width / pieces.width, size.height / pieces.height);
  return cv::repeat(fractal_noise(piece, cells, octaves, gain, seed, name), pieces.height,
                    pieces.width);
}

/// Coarse noise, generated small and enlarged; `gain` as for fractal_noise.
cv::Mat coarse_noise(cv::Size size, cv::Size cells, int octaves, double gain, std::uint64_t seed,
                     std::string_view name) {
  constexpr int kBeyond = 4;  // px of the next tile, so that the enlarged image has no seam
  const cv::Size small(size.width / 4, size.height / 4);
  cv::Mat wrapped, large;
  cv::copyMakeBorder(fractal_noise(small, cells, octaves, gain, seed, name), wrapped, kBeyond,
                     kBeyond, kBeyond, kBeyond, cv::BORDER_WRAP);
  cv::resize(wrapped, large, wrapped.size() * 4, 0, 0, cv::INTER_LINEAR);
  return large(cv::Rect(cv::Point(4 * kBeyond, 4 * kBeyond), size)).clone();
}

/// Short grass from above, without individual blades.
cv::Mat turf(cv::Size size, int cells, std::uint64_t seed, std::string_view name) {
  const cv::Size grid(cells, cells * size.height / size.width);
  return blend(fractal_noise(size, grid, 6, 0.85, seed, name), {28, 40, 18}, {124, 138, 74});
}

/// Fibres one or two texels wide, straight or broken once, each with its shadow beside it: straw,
/// roots and mown grass.
void scatter_fibres(cv::Mat& rgb, RandomSequence& random, int count, const cv::Vec3d& colour,
                    double length, const cv::Mat* share = nullptr) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double reach = length * random.uniform(0.2, 1.0);
    const cv::Point2d along(reach * std::cos(angle), reach * std::sin(angle));
    const cv::Point2d knee =
        0.5 * along + random.uniform(-0.15, 0.15) * cv::Point2d(-along.y, along.x);
    const cv::Scalar skin = jitter(random, colour, 0.35);
    const bool lies = !share || random.uniform() < value_at(*share, at);
    if (!lies) continue;
    const cv::Point2d below(1, 1);
    draw_wrapped(rgb, at, length, [&](const cv::Point2d& p) {
      cv::line(rgb, p + below, p + along + below, cv::Scalar(34, 30, 22), 1, cv::LINE_AA);
      cv::line(rgb, p, p + knee, skin, 1, cv::LINE_AA);
      cv::line(rgb, p + knee, p + along, skin, 1, cv::LINE_AA);
    });
  }
}

/// Green of grass, or the cooler one of clover and other herbs among it.
cv::Vec3d herb(RandomSequence& random) {
  const bool clover = random.below(3) == 0;
  const double red = random.uniform(0, 1), green = random.uniform(0, 1);
  const double blue = random.uniform(0, 1);
  if (clover) return {66 + 34 * red, 98 + 36 * green, 50 + 28 * blue};
  return {78 + 48 * red, 96 + 36 * green, 42 + 32 * blue};
}

/// Darker and lighter patches as wide as tufts and clods.
void mottle(cv::Mat& rgb, cv::Size cells, double depth, std::uint64_t seed, std::string_view name) {
  const cv::Mat patches = coarse_noise(rgb.size(), cells, 3, 0.7, seed, name);
  for (int y = 0; y < rgb.rows; ++y) {
    const auto* patch = patches.ptr<float>(y);
    auto* to = rgb.ptr<float>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      const double off = std::clamp(3.0 * (static_cast<double>(patch[x]) - 0.5), -1.0, 1.0);
      const auto light = static_cast<float>(1 + depth * off);
      for (int c = 0; c < 3; ++c) to[3 * x + c] *= light;
    }
  }
}

/// Blades of grass, 2 to 7 cm long, where `share` says so.
void scatter_blades(cv::Mat& rgb, RandomSequence& random, const cv::Mat& share, int count,
                    double scale) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double length = scale * random.uniform(0.02, 0.07);
    const cv::Vec3d fresh = herb(random);
    const cv::Vec3d dry(random.uniform(140, 186), random.uniform(130, 168), 98);
    const cv::Scalar skin = jitter(random, random.below(4) == 0 ? dry : fresh, 0.45);
    const bool grows = random.uniform() < value_at(share, at);
    if (!grows) continue;
    const cv::Point2d offset(length * std::cos(angle), length * std::sin(angle));
    draw_wrapped(rgb, at, 2 * length, [&](const cv::Point2d& p) {
      const cv::Point2d below(p.x + 1, p.y + 1);
      cv::line(rgb, below, below + offset, cv::Scalar(26, 34, 16), 1, cv::LINE_AA);
      cv::line(rgb, p, p + offset, skin, 1, cv::LINE_AA);
    });
  }
}

/// Tufts from above: dark centre and bright tips, `reach` m at most.
void scatter_tufts(cv::Mat& rgb, RandomSequence& random, const cv::Mat& share, int count,
                   double reach_px) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const double reach = reach_px * random.uniform(0.35, 1.0);
    const cv::Vec3d tip = herb(random);
    const cv::Vec3d heart(34, 46, 18);
    const double first = random.uniform(0, 2 * std::numbers::pi);
    const int blades = 12 + random.below(10);
    if (value_at(share, at) < random.uniform()) continue;
    draw_wrapped(rgb, at, 2 * reach, [&](const cv::Point2d& p) {
      cv::circle(rgb, p, cvRound(0.2 * reach), heart, cv::FILLED, cv::LINE_AA);
    });
    for (int b = 0; b < blades; ++b) {
      const double turn = first + 2 * std::numbers::pi * b / blades + random.uniform(-0.3, 0.3);
      const double length = reach * random.uniform(0.5, 1.0);
      const cv::Point2d offset(length * std::cos(turn), length * std::sin(turn));
      const cv::Scalar skin = jitter(random, tip, 0.3);
      draw_wrapped(rgb, at, 2 * reach, [&](const cv::Point2d& p) {
        cv::line(rgb, p + 0.25 * offset, p + offset, skin, 1 + b % 2, cv::LINE_AA);
      });
    }
  }
}

void scatter_flowers(cv::Mat& rgb, RandomSequence& random, int count) {
  for (int i = 0; i < count; ++i) {
    const cv::Point2d at = somewhere(random, rgb);
    const bool white = random.below(2) == 0;
    const cv::Scalar petals = white ? cv::Scalar(214, 212, 200) : cv::Scalar(206, 176, 52);
    draw_wrapped(rgb, at, 6, [&](const cv::Point2d& p) {
      cv::circle(rgb, p, 2 + i % 2, petals, cv::FILLED, cv::LINE_AA);
    });
  }
}

/// From 1 below `edge` to 0 above, softly.
float below_edge(double value, double edge, double softness) {
  return static_cast<float>(std::clamp(0.5 + (edge - value) / softness, 0.0, 1.0));
}

/// Share of grass on an aisle: none under the vines, worn in the wheel tracks, edges frayed.
cv::Mat grass_share(cv::Size size, const AisleProfile& aisle, std::uint64_t seed) {
  const cv::Mat fray = coarse_noise(size, {12, 24}, 5, 0.7, seed, "fray");
  cv::Mat share(size, CV_32F);
  for (int x = 0; x < size.width; ++x) {
    const double off = std::abs((x + 0.5) / size.width - 0.5) * aisle.width;  // m from the middle
    const double edge = aisle.width / 2 - aisle.bare_strip / 2;
    const double from_track = std::abs(off - aisle.track_gauge / 2);
    for (int y = 0; y < size.height; ++y) {
      const double frayed = 0.24 * (fray.at<float>(y, x) - 0.5);
      const float mown = below_edge(off + frayed, edge, 0.08);
      const float worn = below_edge(from_track + frayed, aisle.track_width / 2, 0.12);
      share.at<float>(y, x) = mown * (1 - 0.8f * worn);
    }
  }
  return share;
}

cv::Mat track_share(cv::Size size, const AisleProfile& aisle, std::uint64_t seed) {
  const cv::Mat fray = coarse_noise(size, {6, 12}, 4, 0.6, seed, "track");
  cv::Mat share(size, CV_32F);
  for (int x = 0; x < size.width; ++x) {
    const double off = std::abs((x + 0.5) / size.width - 0.5) * aisle.width;
    const double from_track = std::abs(off - aisle.track_gauge / 2);
    for (int y = 0; y < size.height; ++y) {
      const double frayed = 0.1 * (fray.at<float>(y, x) - 0.5);
      share.at<float>(y, x) = 0.8f * below_edge(from_track + frayed, aisle.track_width / 2, 0.1);
    }
  }
  return share;
}

}  // namespace

void wither(cv::Mat& rgb, double share, std::uint64_t seed, std::string_view name) {
  if (share <= 0) return;
  const auto by = static_cast<float>(share);
  const cv::Size cells(24, std::max(1, 24 * rgb.rows / rgb.cols));
  const cv::Mat patches = fractal_noise(rgb.size(), cells, 5, 0.85, seed, name);
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      cv::Vec3f& c = rgb.at<cv::Vec3f>(y, x);
      const float dry = std::clamp(14 * (by - patches.at<float>(y, x)) + by, 0.0f, 1.0f);
      const float excess = 2 * c[1] - c[0] - c[2];
      const float green = std::clamp(16 * excess / std::max(c[0] + c[1] + c[2], 1.0f), 0.0f, 1.0f);
      const float light = 0.3f * c[0] + 0.6f * c[1] + 0.1f * c[2];
      const cv::Vec3f straw(1.25f * light, 1.0f * light, 0.73f * light);
      // What keeps green is winter's: cooler than summer's.
      const cv::Vec3f cool(0.84f * c[0], 0.97f * c[1], c[2]);
      c += green * (dry * (straw - c) + (1 - dry) * by * (cool - c));
    }
  }
}

Texture soil_texture(std::uint64_t seed, double withered) {
  const cv::Size size(2048, 2048);
  const cv::Mat clods = fractal_noise(size, {24, 24}, 7, 0.72, seed, "clods");
  const cv::Mat damp = fractal_noise(size, {3, 3}, 4, 0.55, seed, "damp");
  cv::Mat rgb = mix(damp, blend(clods, {56, 40, 28}, {164, 132, 98}),
                    blend(clods, {74, 56, 38}, {192, 164, 128}));
  RandomSequence random(RandomStream(seed, "soil"));
  scatter_stones(rgb, random, 6000, 2, 8);
  scatter_straws(rgb, random, 500, {150, 130, 88}, 60);
  scatter_stones(rgb, random, 1800, 3, 34);
  scatter_fibres(rgb, random, 5000, {186, 166, 122}, 46);
  scatter_fibres(rgb, random, 1500, {84, 66, 46}, 60);
  scatter_leaves(rgb, random, 60 + cvRound(250 * withered), 50);
  scatter_fibres(rgb, random, cvRound(1500 * withered), {96, 70, 50}, 200);
  scatter_fibres(rgb, random, 1600, {96, 112, 56}, 40);
  mottle(rgb, {11, 11}, 0.2, seed, "soil heaps");
  wither(rgb, withered, seed, "soil dry");
  return {"soil", to_rgba(rgb), true};
}

Texture meadow_texture(std::uint64_t seed, double withered) {
  const cv::Size size(1024, 1024);
  cv::Mat rgb = mix(fractal_noise(size, {3, 3}, 4, 0.6, seed, "meadow patches"),
                    turf(size, 10, seed, "meadow"), 1.2 * turf(size, 10, seed, "meadow dry"));
  RandomSequence random(RandomStream(seed, "meadow"));
  const cv::Mat everywhere(size, CV_32F, cv::Scalar(1));
  scatter_blades(rgb, random, everywhere, 14000, size.width / kSoilTile);
  scatter_tufts(rgb, random, everywhere, 420, 0.09 * size.width / kSoilTile);
  scatter_fibres(rgb, random, 2200, {188, 176, 128}, 40);
  scatter_blades(rgb, random, everywhere, 6000, 0.7 * size.width / kSoilTile);
  scatter_flowers(rgb, random, 40);
  scatter_fibres(rgb, random, cvRound(7000 * withered), {206, 176, 122}, 40);
  mottle(rgb, {11, 11}, 0.18, seed, "meadow tufts");
  wither(rgb, withered, seed, "meadow dry");
  return {"meadow", to_rgba(rgb), true};
}

Texture aisle_texture(std::uint64_t seed, const AisleProfile& profile, double withered) {
  const cv::Size size(1536, static_cast<int>(1536 * kAisleLength));
  const double scale = size.width / profile.width;  // px per m
  const cv::Size pieces(2, 4);
  const cv::Mat grass = grass_share(size, profile, seed);
  const cv::Mat track = track_share(size, profile, seed);
  const cv::Mat clods = repeated_noise(size, pieces, {18, 18}, 6, 0.72, seed, "aisle clods");
  const cv::Mat damp = coarse_noise(size, {2, 4}, 4, 0.55, seed, "aisle damp");
  const cv::Mat soil = mix(damp, blend(clods, {50, 36, 24}, {166, 134, 100}),
                           blend(clods, {66, 50, 34}, {194, 166, 130}));
  // Wheel tracks are flat and paler.
  const cv::Mat pressed = blend(clods, {112, 92, 70}, {156, 132, 104});
  cv::Mat rgb = mix(grass, mix(track, soil, pressed),
                    cv::repeat(turf(size / 2, 6, seed, "aisle turf"), 2, 2));
  RandomSequence random(RandomStream(seed, "aisle"));
  const cv::Mat bare = 1 - grass;
  scatter_stones(rgb, random, 5200, 0.003 * scale, 0.028 * scale, &bare);
  scatter_fibres(rgb, random, 9000, {176, 158, 116}, 0.06 * scale, &bare);
  scatter_fibres(rgb, random, 2500, {80, 62, 44}, 0.10 * scale, &bare);
  scatter_leaves(rgb, random, 160 + cvRound(1700 * withered), 0.05 * scale);
  scatter_fibres(rgb, random, cvRound(2500 * withered), {96, 70, 50}, 0.25 * scale);
  scatter_blades(rgb, random, grass, 42000, scale);
  scatter_tufts(rgb, random, grass, 1500, 0.075 * scale);
  scatter_fibres(rgb, random, 7000, {190, 178, 132}, 0.08 * scale, &grass);
  scatter_blades(rgb, random, grass, 14000, 0.7 * scale);
  scatter_fibres(rgb, random, cvRound(16000 * withered), {206, 176, 122}, 0.09 * scale);
  mottle(rgb, {12, 24}, 0.2, seed, "aisle tufts");
  wither(rgb, withered, seed, "aisle dry");
  return {"aisle", to_rgba(rgb), true};
}

Texture grass_texture(std::uint64_t seed, double withered) {
  const cv::Mat streaks = fractal_noise({64, 64}, {8, 2}, 3, 0.6, seed, "grass");
  cv::Mat rgb = blend(streaks, {62, 84, 28}, {142, 154, 72});
  wither(rgb, withered, seed, "grass dry");
  return {"grass", to_rgba(rgb), true};
}

Texture sward_texture(std::uint64_t seed, double withered) {
  const cv::Size size(2048, 64);
  cv::Mat rgb(size, CV_32FC3, cv::Scalar(88, 92, 48)), alpha(size, CV_8UC1, cv::Scalar(0));
  RandomSequence random(RandomStream(seed, "sward blades"));
  const auto stroke = [&](double x, const cv::Point2d& tip, int width, const cv::Scalar& skin) {
    const cv::Point2d foot(x, size.height - 1);
    for (const int wrap : {-size.width, 0, size.width}) {
      const cv::Point2d shift(wrap, 0);
      cv::line(rgb, foot + shift, foot + tip + shift, skin, width);
      cv::line(alpha, foot + shift, foot + tip + shift, cv::Scalar(255), width);
    }
  };
  for (int tuft = 0; tuft < 230; ++tuft) {
    const double middle = random.uniform(0, size.width);
    const double tall = size.height * (0.18 + 0.82 * std::pow(random.uniform(), 2.2));
    const cv::Vec3d fresh = herb(random);
    const cv::Vec3d dry(random.uniform(118, 168), random.uniform(108, 150), 88);
    const cv::Vec3d colour = random.below(4) == 0 ? dry : fresh;
    const int blades = 10 + random.below(16);
    for (int i = 0; i < blades; ++i) {
      const double length = tall * random.uniform(0.35, 1.0), turn = random.normal(0, 0.42);
      const double off = random.normal(0, 0.16 * tall);
      const cv::Scalar skin = jitter(random, colour, 0.4);
      stroke(middle + off, {length * std::sin(turn), -length * std::cos(turn)}, 1 + random.below(2),
             skin);
    }
  }
  wither(rgb, withered, seed, "sward dry");
  return {"sward", to_rgba(rgb, alpha), true};
}

Texture stone_texture(std::uint64_t seed) {
  const cv::Mat grain = fractal_noise({128, 128}, {4, 4}, 5, 0.75, seed, "stone");
  return {"stone", to_rgba(blend(grain, {84, 78, 68}, {186, 176, 158})), true};
}

}  // namespace vinebench::sim
