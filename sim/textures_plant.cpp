// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/textures.h"

namespace vinebench {
namespace {

constexpr int kLeafPixels = 256;
constexpr int kPaintScale = 2;  // leaves are painted larger and averaged down
constexpr int kFoliagePixels = 256;

/// Point of a blade (in sizes) to pixels of a square picture.
cv::Point2f leaf_pixel(const Eigen::Vector2f& p, int side) {
  return {(p.x() + kLeafHalf) / (2 * kLeafHalf) * side,
          (1 - (p.y() - kLeafBottom) / (2 * kLeafHalf)) * side};
}

cv::Point fixed(const cv::Point2f& p) {
  return {cvRound(p.x * 16), cvRound(p.y * 16)};
}

/// The outline with the small teeth that a mesh leaves out.
cv::Mat leaf_alpha(int side, RandomSequence& random) {
  const std::vector<Eigen::Vector2f>& coarse = leaf_outline(2);
  std::vector<cv::Point> outline;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const Eigen::Vector2f& a = coarse[i];
    const Eigen::Vector2f& b = coarse[(i + 1) % coarse.size()];
    constexpr int kTeeth = 3;
    for (int t = 0; t < kTeeth; ++t) {
      const Eigen::Vector2f on = a + (b - a) * (static_cast<float>(t) / kTeeth);
      const Eigen::Vector2f tip = a + (b - a) * ((t + 0.75f) / kTeeth);
      outline.push_back(fixed(leaf_pixel(on * 0.97f, side)));
      outline.push_back(
          fixed(leaf_pixel(tip * (1.01f + static_cast<float>(random.uniform(0, 0.03))), side)));
    }
  }
  cv::Mat alpha(side, side, CV_8UC1, cv::Scalar(0));
  cv::fillPoly(alpha, std::vector<std::vector<cv::Point>>{outline}, 255, cv::LINE_AA, 4);
  return alpha;
}

void draw_vein(cv::Mat& veins, const Eigen::Vector2f& from, const Eigen::Vector2f& to, int width) {
  cv::line(veins, fixed(leaf_pixel(from, veins.cols)), fixed(leaf_pixel(to, veins.cols)),
           cv::Scalar(1), width, cv::LINE_AA, 4);
}

/// 1 on a vein, 0 between: five from the foot into the lobes, with side veins.
cv::Mat leaf_veins(int side) {
  cv::Mat veins8(side, side, CV_8UC1, cv::Scalar(0));
  cv::Mat veins(side, side, CV_32F, cv::Scalar(0));
  const std::array<std::pair<float, float>, 5> lobes{
      {{0, 1.0f}, {60, 0.84f}, {-60, 0.84f}, {128, 0.6f}, {-128, 0.6f}}};
  for (const auto& [degrees, length] : lobes) {
    const float angle = (90 + degrees) * std::numbers::pi_v<float> / 180;
    const Eigen::Vector2f along(std::cos(angle), std::sin(angle));
    const Eigen::Vector2f across(-along.y(), along.x());
    draw_vein(veins, Eigen::Vector2f::Zero(), length * along, side / 85);
    for (int i = 1; i <= 5; ++i) {
      const float at = length * i / 6.5f, reach = 0.42f * (length - at) + 0.04f;
      for (const float s : {-1.0f, 1.0f}) {
        draw_vein(veins, at * along, (at + 0.75f * reach) * along + s * reach * across, side / 170);
      }
    }
  }
  cv::GaussianBlur(veins, veins, {}, side / 300.0);
  return cv::min(veins, 1.0f);
}

struct LeafColours {
  cv::Vec3f dark, light, vein, edge;
  float edge_share;  // how much of the rim has turned
};

const std::array<LeafColours, kLeafVariants> kLeafColours{{
    {{38, 66, 20}, {86, 122, 40}, {136, 158, 78}, {120, 128, 48}, 0.10f},
    {{46, 76, 24}, {98, 134, 46}, {146, 168, 86}, {150, 146, 60}, 0.20f},
    {{32, 58, 20}, {74, 108, 38}, {122, 146, 74}, {96, 110, 44}, 0.05f},
    {{56, 86, 26}, {118, 150, 52}, {160, 180, 92}, {160, 156, 66}, 0.10f},
    {{44, 70, 22}, {92, 126, 42}, {140, 160, 80}, {148, 112, 50}, 0.40f},
    {{36, 62, 24}, {78, 116, 44}, {126, 150, 82}, {104, 120, 52}, 0.08f},
    {{70, 98, 30}, {138, 164, 62}, {172, 188, 102}, {168, 164, 74}, 0.10f},
    {{58, 74, 22}, {122, 134, 48}, {160, 164, 84}, {158, 104, 48}, 0.55f},
}};

cv::Mat paint_leaf(std::uint64_t seed, int variant) {
  const int side = kLeafPixels * kPaintScale;
  const LeafColours& colours = kLeafColours.at(variant);
  RandomSequence random(RandomStream(seed, "leaf", variant));
  const std::string name = "leaf" + std::to_string(variant);
  const cv::Mat mottle = fractal_noise({side, side}, {5, 5}, 6, 0.62, seed, name);
  cv::Mat rgb = blend(mottle, colours.dark, colours.light);
  const cv::Mat alpha = leaf_alpha(side, random);
  cv::Mat inside, rim;
  cv::distanceTransform(alpha > 127, inside, cv::DIST_L2, 3);
  cv::Mat turned = 1.6 * colours.edge_share - inside / (0.16 * side) + (mottle - 0.5) * 1.2;
  turned = cv::min(cv::max(turned, 0.0f), 1.0f);
  rgb = mix(turned, rgb, cv::Mat(rgb.size(), CV_32FC3, cv::Scalar(colours.edge)));
  const cv::Mat vein = 0.75 * leaf_veins(side);
  rgb = mix(vein, rgb, cv::Mat(rgb.size(), CV_32FC3, cv::Scalar(colours.vein)));
  const int spots = 3 + random.below(8);
  for (int i = 0; i < spots; ++i) {
    const cv::Point2d at(random.uniform(0.2, 0.8) * side, random.uniform(0.1, 0.8) * side);
    const cv::Scalar brown(random.uniform(60, 110), random.uniform(50, 70), random.uniform(20, 35));
    cv::circle(rgb, at, 1 + random.below(side / 70), brown, cv::FILLED, cv::LINE_AA);
  }
  cv::Mat small;
  cv::resize(to_rgba(rgb, alpha), small, {kLeafPixels, kLeafPixels}, 0, 0, cv::INTER_AREA);
  return small;
}

/// Lays a leaf over a clump: turned by `degrees`, its foot at `foot`, darkened by `shade`.
void stamp_leaf(cv::Mat& clump, const cv::Mat& leaf, const cv::Point2d& foot, double degrees,
                double scale, double shade) {
  const cv::Point2f pivot = leaf_pixel(Eigen::Vector2f::Zero(), leaf.cols);
  cv::Mat turn = cv::getRotationMatrix2D(pivot, degrees, scale);
  turn.at<double>(0, 2) += foot.x - pivot.x;
  turn.at<double>(1, 2) += foot.y - pivot.y;
  cv::Mat moved;
  cv::warpAffine(leaf, moved, turn, clump.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                 cv::Scalar(0, 0, 0, 0));
  for (int y = 0; y < clump.rows; ++y) {
    for (int x = 0; x < clump.cols; ++x) {
      const cv::Vec4b& from = moved.at<cv::Vec4b>(y, x);
      if (from[3] < 128) continue;
      cv::Vec4b& to = clump.at<cv::Vec4b>(y, x);
      for (int c = 0; c < 3; ++c) to[c] = cv::saturate_cast<uchar>(from[c] * shade);
      to[3] = 255;
    }
  }
}

cv::Mat paint_clump(std::uint64_t seed, int variant, const cv::Mat& leaves) {
  RandomSequence random(RandomStream(seed, "foliage", variant));
  cv::Mat clump(kFoliagePixels, kFoliagePixels, CV_8UC4, cv::Scalar(45, 66, 26, 0));
  constexpr int kLeaves = 16;
  for (int i = 0; i < kLeaves; ++i) {
    const int cell = random.below(kLeafVariants);
    const cv::Rect where((cell % 4) * kLeafPixels, (cell / 4) * kLeafPixels, kLeafPixels,
                         kLeafPixels);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double out = 0.30 * kFoliagePixels * std::sqrt(random.uniform());
    const cv::Point2d foot(kFoliagePixels * 0.5 + out * std::cos(angle),
                           kFoliagePixels * 0.45 + out * std::sin(angle));
    const double shade = 0.55 + 0.5 * i / kLeaves;  // later ones lie on top, in the light
    stamp_leaf(clump, leaves(where), foot, 180 + random.uniform(-70, 70),
               random.uniform(0.32, 0.46), shade);
  }
  return clump;
}

/// Cells of a 4 by n atlas, kept half a texel from the neighbours.
TextureCell atlas_cell(int index, int columns, int rows, float rim) {
  const Eigen::Vector2f size(1.0f / columns, 1.0f / rows);
  const Eigen::Vector2f from(size.x() * (index % columns), size.y() * (index / columns));
  return {from + rim * size, from + (1 - rim) * size};
}

}  // namespace

Texture leaf_texture(std::uint64_t seed) {
  Texture texture{"leaf", cv::Mat(2 * kLeafPixels, 4 * kLeafPixels, CV_8UC4), false};
  for (int i = 0; i < kLeafVariants; ++i) {
    const cv::Rect cell((i % 4) * kLeafPixels, (i / 4) * kLeafPixels, kLeafPixels, kLeafPixels);
    paint_leaf(seed, i).copyTo(texture.rgba(cell));
  }
  return texture;
}

TextureCell leaf_cell(int variant) {
  return atlas_cell(variant, 4, 2, 0.5f / kLeafPixels);
}

Texture foliage_texture(std::uint64_t seed, const Texture& leaves) {
  Texture texture{"foliage", cv::Mat(2 * kFoliagePixels, 2 * kFoliagePixels, CV_8UC4), false};
  for (int i = 0; i < kFoliageVariants; ++i) {
    const cv::Rect cell((i % 2) * kFoliagePixels, (i / 2) * kFoliagePixels, kFoliagePixels,
                        kFoliagePixels);
    paint_clump(seed, i, leaves.rgba).copyTo(texture.rgba(cell));
  }
  return texture;
}

TextureCell foliage_cell(int variant) {
  return atlas_cell(variant, 2, 2, 0.5f / kFoliagePixels);
}

Texture bark_texture(std::uint64_t seed) {
  const cv::Size size(256, 512);
  const cv::Mat fibres = fractal_noise(size, {16, 4}, 5, 0.7, seed, "bark");
  const cv::Mat patches = fractal_noise(size, {4, 6}, 4, 0.6, seed, "bark patches");
  cv::Mat ridges = cv::abs(fibres - 0.5) * 2.4;  // cracks where the noise crosses its middle
  ridges = cv::min(ridges, 1.0f);
  const cv::Mat bark = blend(ridges, {36, 28, 22}, {132, 112, 92});
  const cv::Mat grey = blend(ridges, {52, 46, 40}, {164, 152, 136});
  return {"bark", to_rgba(mix(patches, bark, grey)), true};
}

Texture cane_texture(std::uint64_t seed) {
  const cv::Size size(64, 128);
  const cv::Mat streaks = fractal_noise(size, {16, 4}, 3, 0.6, seed, "cane");
  return {"cane", to_rgba(blend(streaks, {84, 74, 34}, {146, 128, 72})), true};
}

Texture berry_texture(std::uint64_t seed) {
  const cv::Size size(64, 64);
  const cv::Mat bloom = fractal_noise(size, {3, 3}, 5, 0.6, seed, "berry");
  return {"berry", to_rgba(blend(bloom, {26, 22, 44}, {104, 104, 140})), true};
}

Texture bunch_texture(std::uint64_t seed) {
  const int side = 128, rows = 8;
  const cv::Mat dark = fractal_noise({side, side}, {8, 8}, 3, 0.6, seed, "bunch");
  cv::Mat rgb = blend(dark, {12, 10, 20}, {30, 26, 44});
  RandomSequence random(RandomStream(seed, "bunch"));
  const double step = static_cast<double>(side) / rows;
  for (int i = 0; i < rows * rows; ++i) {
    const cv::Point2d at((i % rows + 0.5 * (i / rows % 2) + random.uniform(-0.15, 0.15)) * step,
                         (i / rows + 0.5 + random.uniform(-0.15, 0.15)) * step);
    const cv::Scalar skin(random.uniform(40, 64), random.uniform(38, 56), random.uniform(68, 96));
    for (const double wrap : {-1.0, 0.0}) {
      const cv::Point2d centre = at + cv::Point2d(wrap * side, 0);
      cv::circle(rgb, centre, cvRound(0.5 * step), skin, cv::FILLED, cv::LINE_AA);
      cv::circle(rgb, centre - cv::Point2d(0, 0.18 * step), cvRound(0.2 * step), skin * 1.5,
                 cv::FILLED, cv::LINE_AA);
    }
  }
  return {"bunch", to_rgba(rgb), true};
}

}  // namespace vinebench
