// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/util/random.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

// Procedural images; the same seed gives the same bytes.

/// Smooth noise scaled to [0, 1], CV_32F, seamlessly tileable: octaves, the first with `cells`
/// bumps per side, each of twice the cells and `gain` times the height of the one before.
cv::Mat fractal_noise(cv::Size size, cv::Size cells, int octaves, double gain, std::uint64_t seed,
                      std::string_view name);

/// Pixel by pixel from `low` to `high` (RGB, 0 to 255) as `amount` goes from 0 to 1: CV_32FC3.
cv::Mat blend(const cv::Mat& amount, const cv::Vec3f& low, const cv::Vec3f& high);

/// Pixel by pixel from image `a` to `b`, both CV_32FC3, or to a colour, as `amount` goes from 0
/// to 1. What is moved in becomes the result.
cv::Mat mix(const cv::Mat& amount, const cv::Mat& a, const cv::Mat& b);
cv::Mat mix(const cv::Mat& amount, cv::Mat&& a, const cv::Mat& b);
cv::Mat mix(const cv::Mat& amount, cv::Mat&& a, const cv::Vec3f& colour);

/// CV_32FC3 of 0 to 255 (and 8-bit alpha, opaque where empty) to the CV_8UC4 of a Texture.
cv::Mat to_rgba(const cv::Mat& rgb, const cv::Mat& alpha = {});

// Of the ground: `withered` is the share of green that is straw and litter, 0 to 1.

/// For kSoilTile metres a side.
Texture soil_texture(std::uint64_t seed, double withered = 0);
inline constexpr double kSoilTile = 2.3;  ///< m; not a multiple of common spacings
/// Grass, for kSoilTile metres a side.
Texture meadow_texture(std::uint64_t seed, double withered = 0);

/// Cross-section of a mown aisle with wheel tracks; m.
struct AisleProfile {
  double width = 2.5;         ///< from row to row
  double bare_strip = 0.8;    ///< half of it on either side
  double track_gauge = 1.25;  ///< between the tracks' middles
  double track_width = 0.28;
};
/// From row to row across (u) and kAisleLength times as far along (v).
Texture aisle_texture(std::uint64_t seed, const AisleProfile& profile, double withered = 0);
inline constexpr double kAisleLength = 2;

Texture wood_texture(std::uint64_t seed);
/// White-based, to be multiplied by the box's colour: plain above v = 0.5, with a tape below.
Texture carton_texture(std::uint64_t seed);
/// The same with a logo, lines of text and symbols.
Texture print_texture(std::uint64_t seed);
Texture cloth_texture(std::uint64_t seed);  ///< almost white, for clothes and plastics
Texture grass_texture(std::uint64_t seed, double withered = 0);
/// Standing blades seen from the side, clear between them: kSwardLength m long.
Texture sward_texture(std::uint64_t seed, double withered = 0);
inline constexpr double kSwardLength = 3.2;  ///< m
Texture stone_texture(std::uint64_t seed);
/// Fields and woods on far hills, through the air before them.
Texture woods_texture(std::uint64_t seed, double withered = 0);
/// Trees, bushes, buildings and poles, alpha between and above them: kHedgeLength m long, and
/// kHedgeTop m high between insets of kWallInset of the image.
Texture hedge_texture(std::uint64_t seed, double withered = 0);
inline constexpr double kHedgeLength = 100, kHedgeTop = 9.5;  ///< m
/// Insets avoid interpolation between a repeating image's lower and upper side.
inline constexpr double kWallInset = 0.06;

}  // namespace vinebench::sim
