// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace vinebench::slam {

/// The unknowns of a least-squares problem of many poses. Those that are held are none.
struct Unknowns {
  std::vector<double*> points;  ///< blocks of 3, each in factors with one pose
  /// Blocks of 7 as PoseManifold has them, or of up to 6 without a manifold.
  std::vector<double*> poses;
  std::size_t chain = 0;  ///< so many of the poses, from the first on, follow each other on the way
};

/// A block that stays where points are eliminated.
struct PoseUnknown {
  double* block;
  int size;  ///< 7, or up to 6

  bool is_pose() const { return size == 7; }
  int tangent() const { return is_pose() ? 6 : size; }
};

/// A factor of a point and a pose: up to 3 residuals.
struct Sight {
  const ceres::CostFunction* factor;
  const ceres::LossFunction* loss;
  double* block;                    ///< of the pose
  std::optional<std::size_t> pose;  ///< none where it is held
};

/// A factor of poses alone: up to 6 residuals.
struct Tie {
  static constexpr std::size_t kMostBlocks = 4;

  const ceres::CostFunction* factor;
  const ceres::LossFunction* loss;
  std::size_t count;  ///< of blocks
  std::array<double*, kMostBlocks> blocks;
  std::array<std::optional<std::size_t>, kMostBlocks> poses;
};

/// A problem's factors by what they are of. Points to the problem's own.
struct Terms {
  std::vector<double*> points;
  std::vector<PoseUnknown> poses;
  std::size_t chain = 0;
  std::vector<std::size_t> first;  ///< of each point's sights, and the end
  std::vector<Sight> sights;       ///< point by point, then by pose, those of held ones first
  std::vector<Tie> ties;
};

Terms read_terms(const ceres::Problem& problem, const Unknowns& unknowns);

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
