// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/pose.h"

namespace vinebench::slam {

/// Factors of a point and a body's pose each: up to 3 residuals. Of a long drive they are a
/// million, so they are made where they are asked for.
class Sights {
 public:
  /// Residuals and their derivatives by the step of PoseManifold and by the point, scaled so that
  /// their squares have the gradient of the cost. Residuals that there are not are zero.
  struct Linearised {
    Eigen::Vector3d residual;
    Eigen::Matrix<double, 3, 6> by_pose;
    Eigen::Matrix3d by_point;
  };

  virtual ~Sights() = default;

  /// Half the sum of the squared residuals, under their loss.
  virtual double cost(std::size_t sight, const Pose& T_map_body,
                      const Eigen::Vector3d& p_map) const = 0;
  virtual Linearised linearise(std::size_t sight, const Pose& T_map_body,
                               const Eigen::Vector3d& p_map) const = 0;
};

/// Which point is seen from which pose.
struct Sight {
  std::uint32_t point;
  std::uint32_t pose;
};

/// The unknowns of a least-squares problem of many poses and the factors of points. Other factors
/// are the ceres::Problem's, in which blocks can be held.
struct Unknowns {
  std::vector<double*> points;  ///< blocks of 3
  /// Blocks of 7 as PoseManifold has them, or of up to 6 without a manifold.
  std::vector<double*> poses;
  /// So many poses, from the first on, follow each other on the way. Points are seen from these.
  std::size_t chain = 0;
  std::vector<Sight> sights;  ///< ascending by point, in the order of `factors`
  const Sights* factors = nullptr;
};

/// A block that is not held.
struct Row {
  double* block;
  int size;  ///< 7, or up to 6

  bool is_pose() const { return size == 7; }
  int tangent() const { return is_pose() ? 6 : size; }
};

/// A factor of poses alone: up to 6 residuals.
struct Tie {
  static constexpr std::size_t kMostBlocks = 4;

  const ceres::CostFunction* factor;
  const ceres::LossFunction* loss;
  std::size_t count;  ///< of blocks
  std::array<double*, kMostBlocks> blocks;
  std::array<std::optional<std::size_t>, kMostBlocks> rows;  ///< none of what is held
};

/// All that a problem's cost is of, in the order in which it is summed.
struct Terms {
  /// Of a point, by its pose's row.
  struct SightOfPoint {
    std::uint32_t sight;
    std::uint32_t pose;
  };

  const Unknowns* unknowns;
  std::vector<Row> rows;
  std::vector<std::optional<std::size_t>> row_of;  ///< of each pose
  std::size_t chain = 0;                           ///< rows of these
  std::vector<std::size_t> first;                  ///< of each point's sights, and the end
  std::vector<SightOfPoint> sights;
  std::vector<Tie> ties;
};

/// The unknowns must outlive what is returned.
Terms read_terms(const ceres::Problem& problem, const Unknowns& unknowns);

/// Of the chain, from which points are seen, by their place among the unknowns.
std::vector<Pose> chain_of(const Terms& terms);

/// What a loss makes of a squared residual: half of the cost, and the factor of residual and
/// Jacobian with which their squares have the cost's gradient.
struct Weighed {
  double cost;
  double scale;
};
Weighed weigh(const ceres::LossFunction* loss, double squared_residual);

/// Half the sum of the squared residuals, under their losses.
double cost_of(const Terms& terms);

}  // namespace vinebench::slam
