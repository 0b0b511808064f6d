// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/orb_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "slam/base/random.h"

namespace vinebench {
namespace {

constexpr int kDiscRadius = 15;
constexpr int kBits = 256;
constexpr int kTurns = 128;  ///< directions for which the pattern is tabulated, 2.8 deg apart
constexpr double kPatternSigma = 6.2;  ///< px; a fifth of the patch's side, BRIEF's best

/// Half-width of the disc in the row `dy` from its centre.
std::array<int, kDiscRadius + 1> disc_rows() {
  std::array<int, kDiscRadius + 1> half{};
  for (int dy = 0; dy <= kDiscRadius; ++dy) {
    half[static_cast<std::size_t>(dy)] =
        static_cast<int>(std::sqrt((kDiscRadius + 0.5) * (kDiscRadius + 0.5) - dy * dy));
  }
  return half;
}

/// A comparison of two places about the keypoint, px.
struct Pair {
  std::int8_t ax, ay, bx, by;
};
struct RealPair {
  double ax, ay, bx, by;
};

/// A place within reach, drawn again while it is not; one px less leaves room for rounding.
void draw_place(RandomSequence& draws, double& x, double& y) {
  do {
    x = draws.normal(0, kPatternSigma);
    y = draws.normal(0, kPatternSigma);
  } while (std::hypot(x, y) > kOrbReach - 1);
}

std::vector<RealPair> draw_pattern() {
  RandomSequence draws(RandomStream(20230703, "rotated-brief"));
  std::vector<RealPair> pattern(kBits);
  for (RealPair& pair : pattern) {
    do {
      draw_place(draws, pair.ax, pair.ay);
      draw_place(draws, pair.bx, pair.by);
    } while (std::hypot(pair.ax - pair.bx, pair.ay - pair.by) < 2);
  }
  return pattern;
}

/// The pattern turned to each tabulated direction.
class TurnedPatterns {
 public:
  TurnedPatterns() {
    const std::vector<RealPair> pattern = draw_pattern();
    for (int turn = 0; turn < kTurns; ++turn) {
      const double angle = 2 * std::numbers::pi * turn / kTurns;
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      const auto round8 = [](double v) { return static_cast<std::int8_t>(std::lround(v)); };
      std::transform(pattern.begin(), pattern.end(),
                     turned_[static_cast<std::size_t>(turn)].begin(), [&](const RealPair& p) {
                       return Pair{round8(c * p.ax - s * p.ay), round8(s * p.ax + c * p.ay),
                                   round8(c * p.bx - s * p.by), round8(s * p.bx + c * p.by)};
                     });
    }
  }
  const std::array<Pair, kBits>& nearest(float angle) const {
    const auto turn = std::lround(angle * (kTurns / (2 * std::numbers::pi)));
    return turned_[static_cast<std::size_t>((turn % kTurns + kTurns) % kTurns)];
  }

 private:
  std::array<std::array<Pair, kBits>, kTurns> turned_;
};

}  // namespace

float centroid_angle(const cv::Mat& picture, int x, int y) {
  static const std::array<int, kDiscRadius + 1> half = disc_rows();
  int moment_x = 0;
  int moment_y = 0;
  for (int dy = -kDiscRadius; dy <= kDiscRadius; ++dy) {
    const std::uint8_t* row = picture.ptr<std::uint8_t>(y + dy) + x;
    const int reach = half[static_cast<std::size_t>(std::abs(dy))];
    int sum = 0;
    for (int dx = -reach; dx <= reach; ++dx) {
      sum += row[dx];
      moment_x += dx * row[dx];
    }
    moment_y += dy * sum;
  }
  return std::atan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

Descriptor rotated_brief(const cv::Mat& smoothed, int x, int y, float angle) {
  static const TurnedPatterns patterns;
  const std::uint8_t* centre = smoothed.ptr<std::uint8_t>(y) + x;
  const auto step = static_cast<std::ptrdiff_t>(smoothed.step[0]);
  const std::array<Pair, kBits>& pattern = patterns.nearest(angle);
  Descriptor descriptor{};
  for (std::size_t word = 0; word < descriptor.size(); ++word) {
    std::uint64_t bits = 0;
    for (std::size_t bit = 0; bit < 64; ++bit) {
      const Pair& p = pattern[word * 64 + bit];
      const bool darker = centre[p.ay * step + p.ax] < centre[p.by * step + p.bx];
      bits |= static_cast<std::uint64_t>(darker) << bit;
    }
    descriptor[word] = bits;
  }
  return descriptor;
}

}  // namespace vinebench
