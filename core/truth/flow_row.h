// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vinebench {

/// Optical flow of one row of pixels of a view a into a view b, in vectors as wide as the processor
/// has; the same to the last bit on each.

/// The row's points in b's camera frame, m; directions for sky. Coordinates apart, so that several
/// pixels are computed at once.
struct FlowPoints {
  explicit FlowPoints(std::size_t width) : x(width), y(width), z(width) {}
  std::vector<double> x, y, z;
};

/// Coordinates in b's camera frame of a point of the row at depth z in a, whose ray has the
/// direction (c, r, 1): z (c `across` + `ahead`) + `moved`.
struct RowInView {
  std::array<double, 3> across{};
  std::array<double, 3> ahead{};
  std::array<double, 3> moved{};  ///< m
};

/// `depths` in m, 0 for sky; `columns` are the c of the row's pixels.
void place_points(const float* depths, const std::vector<double>& columns, const RowInView& row,
                  FlowPoints& points);

/// View b: an ideal pinhole's intrinsics, px, and images without gaps between rows.
struct FlowTarget {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  const float* depth = nullptr;    ///< m, 0 for sky
  const float* normals = nullptr;  ///< three a pixel: unit, camera frame
};

/// Where b sees the points of a's row y, whose depths in a are given. `flow` gets two numbers a
/// pixel, px, NaN for what is not in front of b; `visible` 255 where b sees the point (as
/// optical_flow() says), else 0.
void find_points(const FlowTarget& b, const float* depths, int y, const FlowPoints& points,
                 float* flow, std::uint8_t* visible);

}  // namespace vinebench
