// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/orb_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

constexpr int kDiscRadius = 15;
constexpr int kDiscColumns = 32;  ///< a round number for the processor, one more than the disc has
constexpr int kBits = 256;
constexpr int kTurns = 128;  ///< directions for which the pattern is tabulated, 2.8 deg apart
constexpr double kPatternSigma = 6.2;  ///< px; a fifth of the patch's side, BRIEF's best

/// One row of the disc: weights of 32 pixels from 15 left of the centre on, 0 outside of the disc.
struct DiscRow {
  std::array<std::int16_t, kDiscColumns> one;     ///< 1 inside
  std::array<std::int16_t, kDiscColumns> across;  ///< x from the centre, inside
};

std::array<DiscRow, 2 * kDiscRadius + 1> disc_rows() {
  std::array<DiscRow, 2 * kDiscRadius + 1> rows{};
  for (int dy = -kDiscRadius; dy <= kDiscRadius; ++dy) {
    const int reach =
        static_cast<int>(std::sqrt((kDiscRadius + 0.5) * (kDiscRadius + 0.5) - dy * dy));
    DiscRow& row = rows[static_cast<std::size_t>(dy + kDiscRadius)];
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto i = static_cast<std::size_t>(dx + kDiscRadius);
      row.one[i] = 1;
      row.across[i] = static_cast<std::int16_t>(dx);
    }
  }
  return rows;
}

constexpr int kPatchRadius = kOrbReach;
constexpr int kPatchSide = 2 * kPatchRadius + 1;
constexpr int kPatchPitch = 48;  ///< bytes from a row of the copied surroundings to the next

/// A comparison of two places in the copied surroundings of a keypoint.
struct Comparison {
  std::uint16_t a, b;
};
/// The same about the keypoint, px.
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
      const auto place = [&](double x, double y) {
        const auto column = kPatchRadius + std::lround(c * x - s * y);
        const auto row = kPatchRadius + std::lround(s * x + c * y);
        return static_cast<std::uint16_t>(row * kPatchPitch + column);
      };
      std::transform(pattern.begin(), pattern.end(),
                     turned_[static_cast<std::size_t>(turn)].begin(), [&](const RealPair& p) {
                       return Comparison{place(p.ax, p.ay), place(p.bx, p.by)};
                     });
    }
  }
  const std::array<Comparison, kBits>& nearest(float angle) const {
    const auto turn = std::lround(angle * (kTurns / (2 * std::numbers::pi)));
    return turned_[static_cast<std::size_t>((turn % kTurns + kTurns) % kTurns)];
  }

 private:
  std::array<std::array<Comparison, kBits>, kTurns> turned_;
};

}  // namespace

float centroid_angle(const cv::Mat& image, int x, int y) {
  static const auto rows = disc_rows();
  int moment_x = 0;
  int moment_y = 0;
  for (int dy = -kDiscRadius; dy <= kDiscRadius; ++dy) {
    const std::uint8_t* grey = image.ptr<std::uint8_t>(y + dy) + x - kDiscRadius;
    const DiscRow& row = rows[static_cast<std::size_t>(dy + kDiscRadius)];
    int sum = 0;
    for (std::size_t i = 0; i < kDiscColumns; ++i) {
      sum += row.one[i] * grey[i];
      moment_x += row.across[i] * grey[i];
    }
    moment_y += dy * sum;
  }
  return std::atan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

Descriptor rotated_brief(const cv::Mat& smoothed, int x, int y, float angle) {
  static const TurnedPatterns patterns;
  // Copied together, every place has one offset whatever the image's width.
  std::array<std::uint8_t, kPatchSide * kPatchPitch> patch;
  for (int row = 0; row < kPatchSide; ++row) {
    std::memcpy(&patch[static_cast<std::size_t>(row * kPatchPitch)],
                smoothed.ptr<std::uint8_t>(y - kPatchRadius + row) + x - kPatchRadius, kPatchSide);
  }
  const Comparison* next = patterns.nearest(angle).data();
  Descriptor descriptor;
  for (std::uint64_t& word : descriptor) {
    word = 0;
    for (int bit = 0; bit < 64; ++bit, ++next) {
      word += word + static_cast<std::uint64_t>(patch[next->a] < patch[next->b]);
    }
  }
  return descriptor;
}

}  // namespace vinebench::slam
