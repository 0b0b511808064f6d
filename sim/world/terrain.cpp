// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/angle.h"

namespace vinebench::sim {
namespace {

constexpr double kTile = 4.0;       // m, about the side of a tile
constexpr double kEvenCell = 0.25;  // m; even ground needs no more for its shades
constexpr double kFade = 2.0;       // m over which the bumps end at the grid's edge
constexpr std::array<double, 3> kOctaveShare{0.70, 0.22, 0.08};
constexpr double kOctaveRatio = 2.6;

double smooth(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

/// Two whole numbers, of either sign, as one.
std::uint64_t key_of(std::int64_t x, std::int64_t y) {
  return (static_cast<std::uint64_t>(x + (1LL << 31)) << 32) ^
         static_cast<std::uint64_t>(y + (1LL << 31));
}

}  // namespace

Terrain::Terrain(const TerrainConfig& config, const GroundConfig& ground,
                 const std::vector<RowConfig>& rows)
    : config_(config), ground_(ground), frame_(row_frame(rows)) {
  const double uphill = config_.slope_heading_deg * kRadiansPerDegree - frame_.heading();
  slope_ = config_.slope_percent / 100 * Eigen::Vector2d(std::cos(uphill), std::sin(uphill));
  const auto seed = static_cast<std::uint64_t>(config_.seed);
  for (std::size_t i = 0; i < kOctaveShare.size(); ++i) {
    octaves_.emplace_back(seed, "terrain", i);
  }
  lay_grid(config_.margin);
}

void Terrain::lay_grid(double margin) {
  const double wanted = flat() ? std::max(kEvenCell, config_.cell) : config_.cell;
  const double width = frame_.spacing;
  const int aisles = std::max(1, static_cast<int>(std::round(kTile / width)));
  cells_aisle_ = 4 * std::max(1, static_cast<int>(std::round(width / (4 * wanted))));
  cells_y_ = aisles * cells_aisle_;
  const Eigen::Vector2d rows = frame_.rows.sizes();
  const double inner = rows.x() + 2 * kRowEnd;
  const int inner_tiles = std::max(1, static_cast<int>(std::round(inner / kTile)));
  const Eigen::Vector2d tile(inner / inner_tiles, aisles * width);
  cells_x_ = 20 * std::max(1, static_cast<int>(std::round(tile.x() / (20 * wanted))));
  cell_ = {tile.x() / cells_x_, width / cells_aisle_};

  const int before_x = static_cast<int>(std::ceil((margin - kRowEnd) / tile.x()));
  const int before_y = static_cast<int>(std::ceil(margin / tile.y()));
  low_ = frame_.rows.min() - Eigen::Vector2d(kRowEnd + before_x * tile.x(), before_y * tile.y());
  tiles_x_ = inner_tiles + 2 * before_x;
  tiles_y_ = static_cast<int>(std::ceil(rows.y() / tile.y() - 1e-9)) + 2 * before_y;
}

/// Value noise in [-1, 1]: random heights on a lattice, joined smoothly.
double Terrain::noise(const Eigen::Vector2d& p, double wavelength, int octave) const {
  const Eigen::Vector2d q = p / wavelength;
  const auto x = static_cast<std::int64_t>(std::floor(q.x()));
  const auto y = static_cast<std::int64_t>(std::floor(q.y()));
  const double u = smooth(q.x() - std::floor(q.x())), v = smooth(q.y() - std::floor(q.y()));
  const auto at = [&](std::int64_t i, std::int64_t j) {
    return octaves_[static_cast<std::size_t>(octave)].uniform(key_of(i, j), -1, 1);
  };
  const double near = at(x, y) + u * (at(x + 1, y) - at(x, y));
  const double far = at(x, y + 1) + u * (at(x + 1, y + 1) - at(x, y + 1));
  return near + v * (far - near);
}

double Terrain::bumps(const Eigen::Vector2d& p) const {
  double sum = 0, wavelength = config_.wavelength / 2;  // a bump and its hollow
  for (std::size_t i = 0; i < kOctaveShare.size(); ++i) {
    sum += kOctaveShare[i] * noise(p, wavelength, static_cast<int>(i));
    wavelength /= kOctaveRatio;
  }
  return config_.amplitude * sum;
}

/// Two tracks in the middle of every aisle, from headland to headland.
double Terrain::ruts(const Eigen::Vector2d& p) const {
  if (!frame_.regular || config_.rut_depth == 0) return 0;
  const double aisle = (p.y() - frame_.rows.min().y()) / frame_.spacing - 0.5;
  const double off = std::abs(aisle - std::round(aisle)) * frame_.spacing;
  const double from_track = (off - ground_.track_gauge / 2) / (0.6 * ground_.track_width);
  return -config_.rut_depth * std::exp(-from_track * from_track);
}

double Terrain::fade(const Eigen::Vector2d& p) const {
  const Eigen::AlignedBox2d edge = box();
  const double inside = std::min((p - edge.min()).minCoeff(), (edge.max() - p).minCoeff());
  return smooth(std::clamp(inside / kFade, 0.0, 1.0));
}

double Terrain::node_height(int column, int row) const {
  if (flat()) return 0;
  const Eigen::Vector2d p = node(column, row);
  return slope(p) + fade(p) * (bumps(p) + ruts(p));
}

double Terrain::height(const Eigen::Vector2d& p_world) const {
  if (flat()) return 0;
  const Eigen::Vector2d p = frame_.from_world(p_world);
  if (!box().contains(p)) return slope(p);
  const Eigen::Vector2d q = (p - low_).cwiseQuotient(cell_);
  const int i = std::clamp(static_cast<int>(q.x()), 0, columns() - 2);
  const int j = std::clamp(static_cast<int>(q.y()), 0, rows() - 2);
  const double u = q.x() - i, v = q.y() - j;
  const double low = node_height(i, j), high = node_height(i + 1, j + 1);
  if (u >= v) {
    const double side = node_height(i + 1, j);
    return low + u * (side - low) + v * (high - side);
  }
  const double side = node_height(i, j + 1);
  return low + v * (side - low) + u * (high - side);
}

Eigen::Vector3d Terrain::normal(const Eigen::Vector2d& p_world, double reach) const {
  if (flat()) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d x(reach, 0), y(0, reach);
  const double by_x = (height(p_world + x) - height(p_world - x)) / (2 * reach);
  const double by_y = (height(p_world + y) - height(p_world - y)) / (2 * reach);
  return Eigen::Vector3d(-by_x, -by_y, 1).normalized();
}

Pose Terrain::lie(const Eigen::Vector2d& p_world, double yaw, double reach) const {
  const Eigen::Vector3d at(p_world.x(), p_world.y(), height(p_world));
  const Eigen::Quaterniond turned = from_roll_pitch_yaw({0, 0, yaw});
  if (flat()) return {turned, at};
  const Eigen::Quaterniond lean =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal(p_world, reach));
  return {(lean * turned).normalized(), at};
}

}  // namespace vinebench::sim
