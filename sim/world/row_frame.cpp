// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/row_frame.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vinebench::sim {
namespace {

constexpr double kParallel = 1e-3;      // rad
constexpr double kEven = 0.01;          // m
constexpr double kAloneSpacing = 2.5;   // m, of a single row
constexpr double kLeastSpacing = 0.25;  // m

/// The rows' places across the frame, in order; empty where one is not parallel to it.
std::vector<double> offsets(const std::vector<RowConfig>& rows, const RowFrame& frame) {
  std::vector<double> places;
  for (const RowConfig& row : rows) {
    const Eigen::Vector2d start = frame.from_world(row.start), end = frame.from_world(row.end);
    if (std::abs(end.y() - start.y()) > kParallel * (end - start).norm()) return {};
    places.push_back((start.y() + end.y()) / 2);
  }
  std::ranges::sort(places);
  return places;
}

/// The one distance between all neighbours, or nothing. Rows in line count as one.
std::optional<double> even_spacing(const std::vector<double>& places) {
  std::vector<double> apart;
  for (std::size_t i = 1; i < places.size(); ++i) apart.push_back(places[i] - places[i - 1]);
  std::erase_if(apart, [](double distance) { return distance < kEven; });
  if (apart.empty()) return kAloneSpacing;
  const auto [least, most] = std::ranges::minmax(apart);
  if (most - least > kEven || least < kLeastSpacing) return std::nullopt;
  return (places.back() - places.front()) / static_cast<double>(apart.size());
}

}  // namespace

RowFrame row_frame(const std::vector<RowConfig>& rows) {
  RowFrame frame;
  if (rows.empty()) return frame;
  frame.origin = rows.front().start;
  frame.along = (rows.front().end - frame.origin).normalized();
  const std::vector<double> places = offsets(rows, frame);
  const std::optional<double> spacing = places.empty() ? std::nullopt : even_spacing(places);
  frame.regular = spacing.has_value();
  if (spacing) {
    frame.spacing = *spacing;
  } else {
    frame.along = Eigen::Vector2d::UnitX();
  }
  for (const RowConfig& row : rows) {
    frame.rows.extend(frame.from_world(row.start)).extend(frame.from_world(row.end));
  }
  return frame;
}

}  // namespace vinebench::sim
