// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/schur_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/cross_matrix.h"
#include "slam/factors/pose_manifold.h"
#include "slam/solver/reduced_system.h"
#include "slam/solver/two_level.h"

namespace vinebench::slam {
namespace {

/// Poses that move as one body, at least, and how many such bodies at most; to factor their
/// equations takes the cube of that.
constexpr std::size_t kBody = 16;
constexpr std::size_t kMostBodies = 200;

/// Of points, as a share of what holds them.
constexpr double kDamping = 1e-5;
constexpr double kMoreDamping = 10;
constexpr double kLessDamping = 1.0 / 3;

/// Poses on the way in runs; others go with the first that they share a factor with.
BlockGroups groups_of(const Terms& terms, const BlockMatrix& matrix) {
  const std::size_t run = std::max(kBody, (terms.chain + kMostBodies - 1) / kMostBodies);
  std::vector<std::optional<std::size_t>> neighbour(terms.rows.size());
  matrix.for_each([&](std::size_t row, std::size_t column, const Matrix6d&) {
    if (row != column && !neighbour[row]) neighbour[row] = column;
  });
  BlockGroups groups;
  groups.count = (terms.chain + run - 1) / run;
  for (std::size_t i = 0; i < terms.rows.size(); ++i) {
    if (i < terms.chain) {
      groups.group.push_back(i / run);
    } else if (terms.rows[i].is_pose() && neighbour[i]) {
      groups.group.push_back(groups.group[*neighbour[i]]);
    } else {
      groups.group.push_back(groups.count++);
    }
  }
  return groups;
}

/// Steps of poses, each in its own frame, where their group turns and moves about its centre.
std::vector<Matrix6d> modes_of(const Terms& terms, const BlockGroups& groups) {
  std::vector<Eigen::Vector3d> sum(groups.count, Eigen::Vector3d::Zero());
  std::vector<double> count(groups.count, 0);
  for (std::size_t i = 0; i < terms.rows.size(); ++i) {
    if (!terms.rows[i].is_pose()) continue;
    sum[groups.group[i]] += from_block(terms.rows[i].block).translation;
    ++count[groups.group[i]];
  }
  std::vector<Matrix6d> modes;
  for (std::size_t i = 0; i < terms.rows.size(); ++i) {
    Matrix6d& mode = modes.emplace_back(Matrix6d::Identity());
    if (!terms.rows[i].is_pose()) continue;
    const std::size_t g = groups.group[i];
    const Pose T_map_body = from_block(terms.rows[i].block);
    const Eigen::Matrix3d R_body_map = T_map_body.rotation.toRotationMatrix().transpose();
    const Eigen::Vector3d arm = T_map_body.translation - sum[g] / count[g];
    mode.topLeftCorner<3, 3>() = R_body_map;
    mode.topRightCorner<3, 3>() = -R_body_map * cross_matrix(arm);
    mode.bottomRightCorner<3, 3>() = R_body_map;
  }
  return modes;
}

/// Conjugate gradients. None where the matrix is not positive definite.
std::optional<BlockVector> solve_poses(const ReducedSystem& system, BlockGroups groups,
                                       const SchurOptions& options) {
  const TwoLevel preconditioner(system.matrix(), std::move(groups));
  if (!preconditioner.definite()) return std::nullopt;
  BlockVector residual;
  for (const Vector6d& g : system.gradient()) residual.push_back(-g);
  BlockVector solution(residual.size(), Vector6d::Zero());
  BlockVector near = preconditioner.solve(residual);
  BlockVector direction = near;
  double left = dot(residual, near);
  const double enough = options.linear_tolerance * options.linear_tolerance * left;
  for (int step = 0; step < options.linear_steps && left > enough; ++step) {
    const BlockVector product = system.matrix() * direction;
    const double curvature = dot(direction, product);
    if (!(curvature > 0)) return std::nullopt;
    const double length = left / curvature;
    for (std::size_t i = 0; i < solution.size(); ++i) {
      solution[i] += length * direction[i];
      residual[i] -= length * product[i];
    }
    near = preconditioner.solve(residual);
    const double before = std::exchange(left, dot(residual, near));
    for (std::size_t i = 0; i < near.size(); ++i) {
      direction[i] = near[i] + left / before * direction[i];
    }
  }
  return solution;
}

/// Values of all unknown blocks.
std::vector<double> values_of(const Terms& terms) {
  std::vector<double> values;
  for (const double* point : terms.unknowns->points) values.insert(values.end(), point, point + 3);
  for (const Row& row : terms.rows) values.insert(values.end(), row.block, row.block + row.size);
  return values;
}

void restore(const std::vector<double>& values, const Terms& terms) {
  auto from = values.begin();
  const auto take = [&](double* block, int size) {
    std::copy_n(from, size, block);
    from += size;
  };
  for (double* point : terms.unknowns->points) take(point, 3);
  for (const Row& row : terms.rows) take(row.block, row.size);
}

void move(const Terms& terms, const BlockVector& steps,
          const std::vector<Eigen::Vector3d>& points_steps) {
  for (std::size_t p = 0; p < terms.unknowns->points.size(); ++p) {
    Eigen::Map<Eigen::Vector3d>(terms.unknowns->points[p]) += points_steps[p];
  }
  for (std::size_t i = 0; i < terms.rows.size(); ++i) {
    const Row& row = terms.rows[i];
    if (row.is_pose()) {
      std::ranges::copy(to_block(from_block(row.block) * step_of(steps[i])), row.block);
    } else {
      for (int k = 0; k < row.size; ++k) row.block[k] += steps[i](k);
    }
  }
}

}  // namespace

double solve_by_schur(ceres::Problem& problem, const Unknowns& unknowns,
                      const SchurOptions& options, const std::atomic<bool>& stop) {
  const Terms terms = read_terms(problem, unknowns);
  ReducedSystem system(terms);
  double cost = cost_of(terms);
  double damping = kDamping;
  for (int i = 0; i < options.iterations && !stop; ++i) {
    system.linearise(damping);
    BlockGroups groups = groups_of(terms, system.matrix());
    groups.modes = modes_of(terms, groups);
    const auto steps = solve_poses(system, std::move(groups), options);
    if (!steps) {
      damping *= kMoreDamping;
      continue;
    }
    const std::vector<double> before = values_of(terms);
    move(terms, *steps, system.points_steps(*steps));
    const double reached = cost_of(terms);
    const double enough = options.tolerance * cost;
    if (reached < cost) {
      damping = std::max(damping * kLessDamping, kDamping);
      if (std::exchange(cost, reached) - reached <= enough) break;
    } else {
      restore(before, terms);
      damping *= kMoreDamping;
      if (reached - cost <= enough) break;
    }
  }
  return cost;
}

}  // namespace vinebench::slam
