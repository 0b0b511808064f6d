// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/reduced_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

namespace vinebench::slam {
namespace {

/// Of the points' damping, for the poses.
constexpr double kPoseShare = 1e-3;

/// Of a point's diagonal; one that nothing holds along an axis has zero there.
constexpr double kLeastDiagonal = 1e-6;

constexpr int kRows = 6;     // of a tie, at most
constexpr int kColumns = 7;  // of a block, at most

}  // namespace

ReducedSystem::ReducedSystem(const Terms& terms) : terms_(terms), matrix_(terms.poses.size()) {
  std::vector<std::size_t> seen;
  const auto expect_all = [&] {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) matrix_.expect(seen[i], seen[j]);
    }
  };
  std::size_t crossings = 0;
  for (std::size_t p = 0; p < terms.points.size(); ++p) {
    seen.clear();
    for (std::size_t s = terms.first[p]; s < terms.first[p + 1]; ++s) {
      const auto pose = terms.sights[s].pose;
      if (pose && (seen.empty() || seen.back() != *pose)) seen.push_back(*pose);
    }
    crossings += seen.size();
    expect_all();
  }
  for (const Tie& tie : terms.ties) {
    seen.clear();
    for (std::size_t b = 0; b < tie.count; ++b) {
      if (tie.poses[b]) seen.push_back(*tie.poses[b]);
    }
    expect_all();
  }
  points_.reserve(terms.points.size());
  crossings_.reserve(crossings);
}

void ReducedSystem::linearise(double damping) {
  matrix_.clear();
  gradient_.assign(terms_.poses.size(), Vector6d::Zero());
  diagonal_ = gradient_;
  points_.clear();
  crossings_.clear();
  for (std::size_t p = 0; p < terms_.points.size(); ++p) eliminate(p, damping);
  for (const Tie& tie : terms_.ties) add(tie);
  damp(damping);
}

void ReducedSystem::eliminate(std::size_t point, double damping) {
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  crosses_.clear();
  crossed_.clear();
  for (std::size_t s = terms_.first[point]; s < terms_.first[point + 1]; ++s) {
    const Sight& sight = terms_.sights[s];
    // Rows that a factor does not have are zero.
    Eigen::Vector3d residuals = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, kColumns, Eigen::RowMajor> by_block;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_point;
    by_block.setZero();
    by_point.setZero();
    const std::array<const double*, 2> blocks{sight.block, terms_.points[point]};
    std::array<double*, 2> jacobians{by_block.data(), by_point.data()};
    sight.factor->Evaluate(blocks.data(), residuals.data(), jacobians.data());
    const double scale = weigh(sight.loss, residuals.squaredNorm()).scale;
    residuals *= scale;
    by_point *= scale;
    own.noalias() += by_point.transpose() * by_point;
    gradient.noalias() += by_point.transpose() * residuals;
    if (!sight.pose) continue;
    const std::size_t pose = *sight.pose;
    const Eigen::Matrix<double, 3, 6> by_pose = scale * by_block.leftCols<6>();
    const Matrix6d of_pose = by_pose.transpose() * by_pose;
    matrix_.at(pose, pose) += of_pose;
    diagonal_[pose] += of_pose.diagonal();
    gradient_[pose].noalias() += by_pose.transpose() * residuals;
    if (crossed_.empty() || crossed_.back() != pose) {
      crossed_.push_back(pose);
      crosses_.push_back(Cross::Zero());
    }
    crosses_.back().noalias() += by_pose.transpose() * by_point;
  }
  own.diagonal() += damping * own.diagonal().cwiseMax(kLeastDiagonal);
  const Eigen::Matrix3d inverse = own.llt().solve(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d alone = inverse * gradient;
  for (std::size_t i = 0; i < crossed_.size(); ++i) {
    const Cross product = crosses_[i] * inverse;
    gradient_[crossed_[i]].noalias() -= crosses_[i] * alone;
    for (std::size_t j = 0; j <= i; ++j) {
      matrix_.at(crossed_[i], crossed_[j]).noalias() -= product * crosses_[j].transpose();
    }
    crossings_.push_back({crossed_[i], crosses_[i].cast<float>()});
  }
  points_.push_back({inverse, gradient, crossings_.size()});
}

void ReducedSystem::add(const Tie& tie) {
  using Jacobian = Eigen::Matrix<double, kRows, 6>;
  Vector6d residuals = Vector6d::Zero();
  std::array<std::array<double, kRows * kColumns>, Tie::kMostBlocks> values{};
  std::array<double*, Tie::kMostBlocks> pointers{};
  for (std::size_t b = 0; b < tie.count; ++b)
    pointers[b] = tie.poses[b] ? values[b].data() : nullptr;
  tie.factor->Evaluate(tie.blocks.data(), residuals.data(), pointers.data());
  const double scale = weigh(tie.loss, residuals.squaredNorm()).scale;
  residuals *= scale;
  std::array<Jacobian, Tie::kMostBlocks> jacobians;
  for (std::size_t b = 0; b < tie.count; ++b) {
    if (!tie.poses[b]) continue;
    const std::size_t row = *tie.poses[b];
    const PoseUnknown& pose = terms_.poses[row];
    jacobians[b].setZero();
    for (int r = 0; r < tie.factor->num_residuals(); ++r) {
      for (int c = 0; c < pose.tangent(); ++c) {
        jacobians[b](r, c) = scale * values[b][static_cast<std::size_t>(r * pose.size + c)];
      }
    }
    gradient_[row].noalias() += jacobians[b].transpose() * residuals;
    diagonal_[row] += jacobians[b].colwise().squaredNorm().transpose();
    for (std::size_t other = 0; other <= b; ++other) {
      if (!tie.poses[other]) continue;
      const std::size_t column = *tie.poses[other];
      const Matrix6d block = jacobians[b].transpose() * jacobians[other];
      if (row >= column) {
        matrix_.at(row, column) += block;
      } else {
        matrix_.at(column, row) += block.transpose();
      }
    }
  }
}

void ReducedSystem::damp(double damping) {
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    Matrix6d& block = matrix_.at(i, i);
    for (int k = 0; k < 6; ++k) {
      block(k, k) += diagonal_[i](k) > 0 ? kPoseShare * damping * diagonal_[i](k) : 1;
    }
  }
}

std::vector<Eigen::Vector3d> ReducedSystem::points_steps(const BlockVector& steps) const {
  std::vector<Eigen::Vector3d> of_points;
  of_points.reserve(points_.size());
  std::size_t c = 0;
  for (const Point& point : points_) {
    Eigen::Vector3d pull = point.gradient;
    for (; c < point.end; ++c) {
      pull.noalias() += crossings_[c].block.cast<double>().transpose() * steps[crossings_[c].pose];
    }
    of_points.push_back(-(point.inverse * pull));
  }
  return of_points;
}

}  // namespace vinebench::slam
