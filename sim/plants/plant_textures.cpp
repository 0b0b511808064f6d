// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "sim/textures/textures.h"

namespace vinebench::sim {
namespace {

constexpr int kLeafPixels = 256;
constexpr int kLeafColumns = 8;  // cells of the atlas
constexpr int kPaintScale = 2;   // leaves are painted larger and averaged down
constexpr int kBunchPixels = 256;

/// Point of a blade (in sizes) to pixels of a square image.
cv::Point2f leaf_pixel(const Eigen::Vector2f& p, int side) {
  return {(p.x() + kLeafHalf) / (2 * kLeafHalf) * side,
          (1 - (p.y() - kLeafBottom) / (2 * kLeafHalf)) * side};
}

cv::Point fixed(const cv::Point2f& p) {
  return {cvRound(p.x * 16), cvRound(p.y * 16)};
}

/// The outline with teeth, which the mesh does not have.
cv::Mat leaf_alpha(int side, const Cultivar::Leaf& look, RandomSequence& random) {
  const std::vector<Eigen::Vector2f>& coarse = leaf_outline(2, static_cast<float>(look.lobes));
  const auto height = static_cast<float>(0.09 * look.teeth);
  std::vector<cv::Point> outline;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const Eigen::Vector2f& a = coarse[i];
    const Eigen::Vector2f& b = coarse[(i + 1) % coarse.size()];
    constexpr int kTeeth = 3;
    for (int t = 0; t < kTeeth; ++t) {
      const Eigen::Vector2f on = a + (b - a) * (static_cast<float>(t) / kTeeth);
      const Eigen::Vector2f tip = a + (b - a) * ((t + 0.75f) / kTeeth);
      const float reach = 1 + height * static_cast<float>(random.uniform(0.2, 0.8));
      outline.push_back(fixed(leaf_pixel(on * (1 - 0.5f * height), side)));
      outline.push_back(fixed(leaf_pixel(tip * reach, side)));
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
cv::Mat leaf_veins(int side, RandomSequence& random) {
  cv::Mat veins8(side, side, CV_8UC1, cv::Scalar(0));
  cv::Mat veins(side, side, CV_32F, cv::Scalar(0));
  const std::array<std::pair<float, float>, 5> lobes{
      {{0, 1.0f}, {60, 0.84f}, {-60, 0.84f}, {128, 0.6f}, {-128, 0.6f}}};
  const auto about = [&](float value, double sigma) {
    return value * static_cast<float>(1 + random.normal(0, sigma));
  };
  for (const auto& [degrees, full] : lobes) {
    const float length = about(full, 0.05);
    const float bent = degrees + static_cast<float>(random.normal(0, 5));
    const float angle = (90 + bent) * std::numbers::pi_v<float> / 180;
    const Eigen::Vector2f along(std::cos(angle), std::sin(angle));
    const Eigen::Vector2f across(-along.y(), along.x());
    draw_vein(veins, Eigen::Vector2f::Zero(), length * along, side / 85);
    const int side_veins = 4 + random.below(3);
    for (int i = 1; i <= side_veins; ++i) {
      for (const float s : {-1.0f, 1.0f}) {
        const float at = about(length * i / (side_veins + 1.5f), 0.06);
        const float reach = 0.42f * (length - at) + 0.04f;
        draw_vein(veins, at * along, (at + 0.75f * reach) * along + s * reach * across, side / 256);
      }
    }
  }
  cv::GaussianBlur(veins, veins, {}, side / 300.0);
  return cv::min(veins, 1.0f);
}

cv::Vec3f bytes(const Eigen::Vector3d& colour) {
  return 255.0f * cv::Vec3f(static_cast<float>(colour.x()), static_cast<float>(colour.y()),
                            static_cast<float>(colour.z()));
}

struct LeafColours {
  cv::Vec3f dark, light, vein, edge;
  float edge_share;  // share of the rim with autumn colour
};

/// Colour variation of one of the atlas' leaves.
struct LeafAge {
  float brightness;
  float yellow;    // of young growth
  float autumn;    // share of the autumn colour
  float withered;  // share of brown
  float edge_share;
};

constexpr std::array<LeafAge, kLeafVariants> kSummer{{{1.00f, 0.00f, 0.00f, 0.00f, 0.05f},
                                                      {1.14f, 0.08f, 0.00f, 0.00f, 0.08f},
                                                      {0.86f, 0.00f, 0.00f, 0.00f, 0.03f},
                                                      {1.24f, 0.14f, 0.00f, 0.00f, 0.05f},
                                                      {1.06f, 0.04f, 0.08f, 0.00f, 0.38f},
                                                      {0.92f, 0.00f, 0.05f, 0.00f, 0.12f},
                                                      {1.40f, 0.35f, 0.00f, 0.00f, 0.00f},
                                                      {1.10f, 0.05f, 0.40f, 0.00f, 0.55f}}};
constexpr std::array<LeafAge, kLeafVariants> kAutumn{{{1.05f, 0.10f, 0.25f, 0.00f, 0.30f},
                                                      {1.15f, 0.10f, 0.45f, 0.00f, 0.35f},
                                                      {1.00f, 0.00f, 0.20f, 0.05f, 0.20f},
                                                      {1.15f, 0.10f, 0.60f, 0.00f, 0.20f},
                                                      {1.10f, 0.00f, 0.95f, 0.00f, 0.15f},
                                                      {1.00f, 0.00f, 0.90f, 0.35f, 0.40f},
                                                      {0.90f, 0.00f, 0.80f, 0.75f, 0.30f},
                                                      {1.15f, 0.00f, 0.80f, 0.10f, 0.30f}}};

LeafColours leaf_colours(const Cultivar::Leaf& look, const LeafAge& age) {
  const cv::Vec3f autumn = bytes(look.autumn), withered(112, 78, 46), yellow(176, 190, 80);
  const auto aged = [&](const cv::Vec3f& green, float shade) {
    cv::Vec3f c = age.brightness * green;
    c += age.yellow * (shade * yellow - c);
    c += age.autumn * (shade * autumn - c);
    return c + age.withered * (shade * withered - c);
  };
  const cv::Vec3f dark = aged(bytes(look.dark), 0.72f), light = aged(bytes(look.light), 1.05f);
  return {dark, light, 0.55f * light + 0.45f * cv::Vec3f(196, 204, 128),
          0.85f * autumn + 0.15f * withered, age.edge_share};
}

/// Light on the blade: its halves are folded, its surface is blistered between the veins.
cv::Mat leaf_relief(int side, RandomSequence& random, std::uint64_t seed, const std::string& name) {
  const double fold = random.normal(0, 0.14), lengthwise = random.normal(0, 0.10);
  cv::Mat light = 0.45 * (fractal_noise({side, side}, {24, 24}, 4, 0.8, seed, name) - 0.5) + 1;
  for (int y = 0; y < side; ++y) {
    const double along = 1 - 2.0 * y / side;
    for (int x = 0; x < side; ++x) {
      const double across = (2.0 * x / side - 1) * 6;
      const double half = across / (1 + std::abs(across));
      light.at<float>(y, x) += static_cast<float>(fold * half + lengthwise * along);
    }
  }
  return light;
}

void light_up(cv::Mat& rgb, const cv::Mat& light) {
  for (int y = 0; y < rgb.rows; ++y) {
    const auto* by = light.ptr<float>(y);
    auto* to = rgb.ptr<float>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      for (int c = 0; c < 3; ++c) to[3 * x + c] *= by[x];
    }
  }
}

cv::Mat paint_leaf(std::uint64_t seed, int variant, int print, const Cultivar::Leaf& look,
                   const LeafColours& colours) {
  const int side = kLeafPixels * kPaintScale;
  RandomSequence random(RandomStream(seed, "leaf", variant * kLeafPrints + print));
  const std::string name = fmt::format("leaf {} {}", variant, print);
  const cv::Mat mottle = fractal_noise({side, side}, {5, 5}, 6, 0.62, seed, name);
  cv::Mat rgb = blend(mottle, colours.dark, colours.light);
  light_up(rgb, leaf_relief(side, random, seed, name + " relief"));
  const cv::Mat alpha = leaf_alpha(side, look, random);
  cv::Mat inside, rim;
  cv::distanceTransform(alpha > 127, inside, cv::DIST_L2, 3);
  cv::Mat turned = 1.6 * colours.edge_share - inside / (0.16 * side) + (mottle - 0.5) * 1.2;
  turned = cv::min(cv::max(turned, 0.0f), 1.0f);
  rgb = mix(turned, std::move(rgb), colours.edge);
  const cv::Mat vein = 0.6 * leaf_veins(side, random);
  rgb = mix(vein, std::move(rgb), colours.vein);
  const int spots = 4 + random.below(16);
  for (int i = 0; i < spots; ++i) {
    const cv::Point2d at(random.uniform(0.2, 0.8) * side, random.uniform(0.1, 0.8) * side);
    const cv::Scalar brown(random.uniform(60, 110), random.uniform(50, 70), random.uniform(20, 35));
    cv::circle(rgb, at, 1 + random.below(side / 90), brown, cv::FILLED, cv::LINE_AA);
  }
  cv::Mat small;
  cv::resize(to_rgba(rgb, alpha), small, {kLeafPixels, kLeafPixels}, 0, 0, cv::INTER_AREA);
  return small;
}

/// Skin below its bloom, a pale wax that hides most of a dark colour.
cv::Vec3f waxed(const cv::Vec3f& skin) {
  const float dark = 1 - std::max({skin[0], skin[1], skin[2]}) / 255;
  const float wax = 0.04f + 0.40f * dark * dark;
  return skin + wax * (cv::Vec3f(158, 162, 170) - skin);
}

bool is_red(const Cultivar::Berry& look) {
  return look.ripe.y() < look.green.y() - 0.15;
}

/// Colour of a berry at ripeness `ripe`, 0 to 1; pink in between.
cv::Vec3f berry_colour(const Cultivar::Berry& look, float ripe) {
  const cv::Vec3f green = waxed(bytes(look.green)), full = waxed(bytes(look.ripe));
  const cv::Vec3f middle = is_red(look) ? cv::Vec3f(126, 84, 84) : 0.5f * (green + full);
  return ripe < 0.5f ? green + 2 * ripe * (middle - green)
                     : middle + (2 * ripe - 1) * (full - middle);
}

/// The colours of the atlas' four berries: at veraison some of a red bunch are green, some
/// coloured; white ones ripen together.
std::array<cv::Vec3f, kBerryVariants> berry_colours(const Cultivar& cultivar,
                                                    const GrowthStage& stage) {
  const bool red = is_red(cultivar.berry);
  std::array<cv::Vec3f, kBerryVariants> colours;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const float ripe = std::clamp(stage.ripe * kBerryVariants - static_cast<float>(i), 0.0f, 1.0f);
    const bool turning = stage.ripe > 0 && stage.ripe < 1;
    const float together =
        std::clamp(stage.ripe + 0.12f * (1.5f - static_cast<float>(i)), 0.0f, 1.0f);
    colours.at(i) = berry_colour(cultivar.berry, !red                ? together
                                                 : turning && i == 1 ? 0.55f
                                                                     : ripe);
    colours.at(i) *= 0.95f + 0.03f * static_cast<float>(i);
    if (stage.bunch > 0 && stage.berry < 0.4f) colours.at(i) = {188, 198, 122};  // flowers
  }
  return colours;
}

/// Skin at a point of a berry's disc (y up, radius 1): lit from above, less where its neighbours
/// are, with the sky's sheen.
cv::Vec3f berry_point(float x, float y, const cv::Vec3f& skin, float rim) {
  constexpr float kSheenX = -0.18f, kSheenY = 0.42f, kSheen = 0.36f;  // place and radius
  const float r2 = std::min(1.0f, x * x + y * y);
  const float light = 0.88f + 0.20f * y + 0.24f * std::sqrt(1 - r2) - rim * r2 * r2 * r2;
  const float off =
      ((x - kSheenX) * (x - kSheenX) + (y - kSheenY) * (y - kSheenY)) / kSheen / kSheen;
  const float sheen = off < 1 ? 0.34f * (1 - off) * (1 - off) : 0.0f;
  return light * skin + sheen * (cv::Vec3f(226, 230, 236) - skin);
}

/// One berry on an image, its edge over half a pixel.
void paint_berry(cv::Mat& rgb, const cv::Point2f& at, const cv::Size2f& radius,
                 const cv::Vec3f& skin) {
  const auto from = [](float middle, float half) { return cvFloor(middle - half); };
  for (int y = std::max(0, from(at.y, radius.height)); y < rgb.rows; ++y) {
    const float up = (at.y - static_cast<float>(y)) / radius.height;
    if (up < -1) break;
    for (int x = std::max(0, from(at.x, radius.width)); x < rgb.cols; ++x) {
      const float right = (static_cast<float>(x) - at.x) / radius.width;
      if (right > 1) break;
      const float inside = (1 - std::sqrt(right * right + up * up)) * radius.width;
      if (inside <= 0) continue;
      auto& pixel = rgb.at<cv::Vec3f>(y, x);
      pixel += std::min(1.0f, inside) * (berry_point(right, up, skin, 0.30f) - pixel);
    }
  }
}

/// Packed berries, seamless around the bunch.
cv::Mat paint_packed(std::uint64_t seed, const Cultivar& cultivar, const GrowthStage& stage) {
  const auto colours = berry_colours(cultivar, stage);
  const int side = kBunchPixels;
  cv::Mat rgb(side, side, CV_32FC3, cv::Scalar(0.42f * colours[1]));
  const double berry = cultivar.berry.diameter * std::max(0.2f, stage.berry);
  const auto width = cultivar.bunch.width * static_cast<double>(stage.bunch_width());
  const int columns = std::clamp(cvRound(2.6 * width / berry), 5, 24);
  const int rows = std::clamp(cvRound(1.15 * cultivar.bunch.length * stage.bunch / berry), 4, 40);
  const cv::Size2d step(static_cast<double>(side) / columns, static_cast<double>(side) / rows);
  RandomSequence random(RandomStream(seed, "bunch"));
  std::vector<int> order(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) {  // some lie before others, on all sides
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  }
  for (const int i : order) {
    const double shift = 0.5 * (i / columns % 2);
    const cv::Point2d at((i % columns + shift + random.uniform(-0.22, 0.22)) * step.width,
                         (i / columns + 0.5 + random.uniform(-0.22, 0.22)) * step.height);
    const double size = random.uniform(0.54, 0.72);
    const cv::Vec3f skin = static_cast<float>(random.uniform(0.82, 1.1)) *
                           colours.at(static_cast<std::size_t>(random.below(kBerryVariants)));
    for (const double wrap : {-1.0, 0.0, 1.0}) {
      paint_berry(rgb, at + cv::Point2d(wrap * side, 0), step * size, skin);
    }
  }
  return rgb;
}

/// Cells of an atlas with that many columns and rows, inset by half a texel.
TextureCell atlas_cell(int index, int columns, int rows, float rim) {
  const Eigen::Vector2f size(1.0f / columns, 1.0f / rows);
  const Eigen::Vector2f from(size.x() * (index % columns), size.y() * (index / columns));
  return {from + rim * size, from + (1 - rim) * size};
}

}  // namespace

Texture leaf_texture(std::uint64_t seed, const Cultivar& cultivar, const GrowthStage& stage) {
  constexpr int kRows = kLeafVariants * kLeafPrints / kLeafColumns;
  Texture texture{"leaf", cv::Mat(kRows * kLeafPixels, kLeafColumns * kLeafPixels, CV_8UC4), false};
  for (int i = 0; i < kLeafVariants * kLeafPrints; ++i) {
    const int variant = i / kLeafPrints;
    const LeafAge& age =
        (stage.autumn > 0.5f ? kAutumn : kSummer).at(static_cast<std::size_t>(variant));
    const cv::Rect cell((i % kLeafColumns) * kLeafPixels, (i / kLeafColumns) * kLeafPixels,
                        kLeafPixels, kLeafPixels);
    paint_leaf(seed, variant, i % kLeafPrints, cultivar.leaf, leaf_colours(cultivar.leaf, age))
        .copyTo(texture.rgba(cell));
  }
  return texture;
}

TextureCell leaf_cell(int variant, int print) {
  constexpr int kRows = kLeafVariants * kLeafPrints / kLeafColumns;
  return atlas_cell(variant * kLeafPrints + print, kLeafColumns, kRows, 0.5f / kLeafPixels);
}

Texture bark_texture(std::uint64_t seed) {
  const cv::Size size(256, 512);
  const cv::Mat fibres = fractal_noise(size, {16, 4}, 5, 0.7, seed, "bark");
  const cv::Mat patches = fractal_noise(size, {4, 6}, 4, 0.6, seed, "bark patches");
  cv::Mat ridges = cv::abs(fibres - 0.5) * 2.4;  // cracks where the noise crosses its mean
  ridges = cv::min(ridges, 1.0f);
  const cv::Mat bark = blend(ridges, {36, 28, 22}, {132, 112, 92});
  const cv::Mat grey = blend(ridges, {52, 46, 40}, {164, 152, 136});
  return {"bark", to_rgba(mix(patches, bark, grey)), true};
}

Texture cane_texture(std::uint64_t seed, const GrowthStage& stage) {
  const cv::Size half(32, 128);
  const cv::Mat streaks = fractal_noise(half, {8, 4}, 3, 0.6, seed, "cane");
  const cv::Mat green = blend(streaks, {82, 104, 40}, {142, 158, 76});
  const cv::Mat brown = stage.shoot == 0
                            ? blend(streaks, {62, 44, 33}, {140, 106, 78})  // weathered
                            : blend(streaks, {94, 62, 38}, {164, 120, 78});
  const cv::Mat patches = fractal_noise(half, {2, 6}, 3, 0.6, seed, "lignified");
  cv::Mat wood =
      cv::min(cv::max(4 * (patches - 0.5) + 4 * (stage.lignified - 0.5) + 0.5, 0.0), 1.0);
  cv::Mat both;
  cv::hconcat(mix(wood, green, brown), brown, both);
  return {"cane", to_rgba(both), true};
}

Texture bunch_texture(std::uint64_t seed, const Cultivar& cultivar, const GrowthStage& stage) {
  const int side = kBunchPixels, cell = side / 2;
  cv::Mat rgb(side, 2 * side, CV_32FC3, cv::Scalar::all(0));
  paint_packed(seed, cultivar, stage).copyTo(rgb(cv::Rect(0, 0, side, side)));
  const auto colours = berry_colours(cultivar, stage);
  for (int i = 0; i < kBerryVariants; ++i) {
    cv::Mat of_berry = rgb(cv::Rect(side + (i % 2) * cell, (i / 2) * cell, cell, cell));
    const cv::Vec3f& skin = colours.at(static_cast<std::size_t>(i));
    // Up is along u, as the meshes have it.
    const float half = 0.5f * static_cast<float>(cell - 1);
    for (int y = 0; y < cell; ++y) {
      for (int x = 0; x < cell; ++x) {
        const float up = (static_cast<float>(x) - half) / half;
        const float right = (static_cast<float>(y) - half) / half;
        of_berry.at<cv::Vec3f>(y, x) = berry_point(right, up, skin, 0.12f);
      }
    }
    // The bloom (a whitish wax) is partly rubbed off.
    const cv::Mat bloom =
        0.25 * fractal_noise({cell, cell}, {3, 3}, 5, 0.6, seed, "berry" + std::to_string(i));
    const cv::Mat wax(of_berry.size(), CV_32FC3, cv::Scalar(0.55f * skin + cv::Vec3f(66, 68, 74)));
    mix(bloom, of_berry, wax).copyTo(of_berry);
  }
  return {"bunch", to_rgba(rgb), false};
}

TextureCell berry_cell(int variant) {
  // Columns 2 and 3 of four, rows 0 and 1 of two.
  return atlas_cell(2 + variant % 2 + 4 * (variant / 2 % 2), 4, 2, 1.0f / kBunchPixels);
}

TextureCell packed_berries_cell() {
  return atlas_cell(0, 2, 1, 0.5f / kBunchPixels);
}

std::vector<Texture> plant_textures(const Cultivar& cultivar, const GrowthStage& stage,
                                    std::uint64_t seed) {
  return {bark_texture(seed), cane_texture(seed, stage), leaf_texture(seed, cultivar, stage),
          bunch_texture(seed, cultivar, stage)};
}

}  // namespace vinebench::sim
