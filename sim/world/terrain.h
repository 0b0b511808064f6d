// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pose.h"
#include "core/util/random.h"
#include "sim/world/ground_config.h"
#include "sim/world/row_frame.h"

namespace vinebench::sim {

/// Aisles begin and end this far beyond the rows' end posts; m.
inline constexpr double kRowEnd = 0.6;

/// The ground's surface, one for physics and image: heights at the nodes of a grid that lies
/// along the rows, and two triangles a cell that share the edge from its (x, y) corner to its
/// (x + 1, y + 1) corner, which is how MuJoCo's collider and rays cut a height field. Beyond the
/// grid the slope goes on without bumps. Heights are computed, not stored: cheap to construct.
class Terrain {
 public:
  Terrain(const TerrainConfig& config, const GroundConfig& ground,
          const std::vector<RowConfig>& rows);

  bool flat() const { return config_.flat(); }
  const RowFrame& frame() const { return frame_; }

  /// m, of the surface at a point of the world.
  double height(const Eigen::Vector2d& p_world) const;

  /// Unit normal of the plane through four points `reach` m around.
  Eigen::Vector3d normal(const Eigen::Vector2d& p_world, double reach) const;

  /// Upright axes at a point, turned by `yaw` about the vertical, then leaned with the ground.
  Pose lie(const Eigen::Vector2d& p_world, double yaw, double reach) const;

  // The grid. It is made of tiles: whole aisles across, so that rows lie on lines of nodes; along
  // the rows, tiles begin where the aisles begin and end where these end.
  int columns() const { return tiles_x_ * cells_x_ + 1; }  ///< nodes along x of the frame
  int rows() const { return tiles_y_ * cells_y_ + 1; }     ///< along y
  double nodes() const { return static_cast<double>(columns()) * rows(); }
  int tiles_x() const { return tiles_x_; }
  int tiles_y() const { return tiles_y_; }
  int cells_x() const { return cells_x_; }  ///< of one tile; divisible by 20
  int cells_y() const { return cells_y_; }
  int cells_aisle() const { return cells_aisle_; }   ///< across one aisle; divisible by 4
  Eigen::Vector2d cell() const { return cell_; }     ///< m
  Eigen::Vector2d node(int column, int row) const {  ///< m, in the frame
    return low_ + Eigen::Vector2d(column * cell_.x(), row * cell_.y());
  }
  Eigen::AlignedBox2d box() const { return {node(0, 0), node(columns() - 1, rows() - 1)}; }
  double node_height(int column, int row) const;  ///< m

 private:
  void lay_grid(double margin);
  double noise(const Eigen::Vector2d& p, double wavelength, int octave) const;
  double bumps(const Eigen::Vector2d& p) const;
  double ruts(const Eigen::Vector2d& p) const;
  double fade(const Eigen::Vector2d& p) const;
  double slope(const Eigen::Vector2d& p) const { return slope_.dot(p - frame_.rows.center()); }

  TerrainConfig config_;
  GroundConfig ground_;
  RowFrame frame_;
  Eigen::Vector2d slope_;  ///< rise over run in the frame
  Eigen::Vector2d low_, cell_;
  int tiles_x_ = 0, tiles_y_ = 0, cells_x_ = 20, cells_y_ = 0, cells_aisle_ = 4;
  std::vector<RandomStream> octaves_;
};

}  // namespace vinebench::sim
