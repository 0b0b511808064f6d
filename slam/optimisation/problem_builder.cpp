// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/problem_builder.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <utility>

namespace vinebench::slam {

namespace {

/// Share of what is known of an unknown that a marginal adds to it, far above rounding. The same
/// number for all would tie the map to its farthest landmarks: one that ran to 1e9 m has 1e-13.
constexpr double kDamping = 1e-12;

constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

ceres::Problem::Options ownership() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

}  // namespace

ProblemBuilder::ProblemBuilder(const Map& map, const AdjustmentWindow& window, bool many)
    : window_(window),
      many_(many),
      pose_index_(map.keyframes().size(), kAbsent),
      problem_(ownership()) {
  poses_.reserve(window_.moved.size() + window_.fixed.size());
  const auto add = [&](int id) {
    pose_index_[static_cast<std::size_t>(id)] = poses_.size();
    poses_.push_back(to_block(map.keyframe(id).T_map_body));
    add_pose(poses_.back().data(), Group::kPoses);
  };
  for (const int id : window_.moved) add(id);
  for (const int id : window_.fixed) {
    add(id);
    hold(pose_of(id));
  }
}

bool ProblemBuilder::takes_part(int keyframe) const {
  return pose_index_[static_cast<std::size_t>(keyframe)] != kAbsent;
}

double* ProblemBuilder::pose_of(int keyframe) {
  return poses_[pose_index_[static_cast<std::size_t>(keyframe)]].data();
}

void ProblemBuilder::add_block(double* block, int size, Group group) {
  problem_.AddParameterBlock(block, size);
  ordering_.AddElementToGroup(block, static_cast<int>(group));
}

void ProblemBuilder::add_pose(double* block, Group group) {
  problem_.AddParameterBlock(block, 7, &manifold_);
  ordering_.AddElementToGroup(block, static_cast<int>(group));
}

void ProblemBuilder::add_factor(ceres::CostFunction& factor, ceres::LossFunction* loss,
                                const std::vector<double*>& blocks) {
  problem_.AddResidualBlock(&factor, loss, blocks);
}

double ProblemBuilder::solve(ceres::Solver::Options options) {
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>(ordering_);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  return summary.final_cost;
}

void ProblemBuilder::set_sights(const Sights& factors, std::vector<double*> points,
                                std::vector<Sight> sights) {
  of_many_.factors = &factors;
  of_many_.points = std::move(points);
  of_many_.sights = std::move(sights);
}

double ProblemBuilder::solve(const SchurOptions& options, const std::atomic<bool>& stop) {
  of_many_.poses.clear();
  for (PoseBlock& pose : poses_) of_many_.poses.push_back(pose.data());
  of_many_.chain = poses_.size();
  for (const auto& [group, blocks] : ordering_.group_to_elements()) {
    if (group == static_cast<int>(Group::kPoses)) continue;
    of_many_.poses.insert(of_many_.poses.end(), blocks.begin(), blocks.end());
  }
  return solve_by_schur(problem_, of_many_, options, stop);
}

ProblemBuilder::Marginal ProblemBuilder::marginal(const std::vector<Group>& last_groups) {
  ceres::Problem::EvaluateOptions options;
  int kept = 0;
  for (const auto& [group, blocks] : ordering_.group_to_elements()) {
    const bool keep = std::ranges::count(last_groups, static_cast<Group>(group)) > 0;
    for (double* block : blocks) {
      if (problem_.IsParameterBlockConstant(block)) continue;
      options.parameter_blocks.push_back(block);
      if (keep) kept += problem_.ParameterBlockTangentSize(block);
    }
  }
  ceres::CRSMatrix crs;
  problem_.Evaluate(options, nullptr, nullptr, nullptr, &crs);
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const Eigen::SparseMatrix<double> J =
      Eigen::Map<const RowMajor>(crs.num_rows, crs.num_cols, static_cast<int>(crs.values.size()),
                                 crs.rows.data(), crs.cols.data(), crs.values.data());
  // In their own order the last unknowns are eliminated last, so that the end of the factor is that
  // of their Schur complement.
  const Eigen::SparseMatrix<double> known = J.transpose() * J;
  // What no factor holds has no part in the others.
  const Eigen::VectorXd damping = known.diagonal().unaryExpr(
      [](double of_one) { return of_one > 0 ? kDamping * of_one : 1.0; });
  const Eigen::SparseMatrix<double> H = known + Eigen::SparseMatrix<double>(damping.asDiagonal());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                              Eigen::NaturalOrdering<int>>
      factor(H);
  const Eigen::SparseMatrix<double> whole(factor.matrixL());
  const Eigen::MatrixXd L = Eigen::MatrixXd(whole.bottomRightCorner(kept, kept));
  const Eigen::VectorXd D = factor.vectorD().tail(kept);
  Marginal marginal{L * D.asDiagonal() * L.transpose(), {}};
  if (window_.moved.empty()) return marginal;
  // With the factor's last rows (P 0; Q L) the pose's step x solves P^T x = -Q^T c.
  const Eigen::Index before = whole.rows() - kept - 6;
  const Eigen::Matrix<double, 6, 6> P = Eigen::MatrixXd(whole.block(before, before, 6, 6));
  const Eigen::MatrixXd Q = Eigen::MatrixXd(whole.block(before + 6, before, kept, 6));
  marginal.of_last_pose = -P.transpose().triangularView<Eigen::Upper>().solve(Q.transpose());
  return marginal;
}

std::vector<Pose> ProblemBuilder::poses(const Map& map) const {
  std::vector<Pose> poses;
  for (const Keyframe& keyframe : map.keyframes()) poses.push_back(keyframe.T_map_body);
  for (const int id : window_.moved) {
    const auto k = static_cast<std::size_t>(id);
    poses[k] = from_block(poses_[pose_index_[k]].data());
  }
  return poses;
}

}  // namespace vinebench::slam
