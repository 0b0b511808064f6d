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

constexpr int kResiduals = 6;  // of a tie, at most
constexpr int kNumbers = 7;    // of a block, at most

}  // namespace

ReducedSystem::ReducedSystem(const Terms& terms) : terms_(terms), matrix_(terms.rows.size()) {
  std::vector<std::size_t> together;
  const auto expect_all = [&] {
    for (std::size_t i = 0; i < together.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) matrix_.expect(together[i], together[j]);
    }
  };
  for (std::size_t p = 0; p + 1 < terms.first.size(); ++p) {
    together.clear();
    for (std::size_t s = terms.first[p]; s < terms.first[p + 1]; ++s) {
      const auto row = terms.row_of[terms.sights[s].pose];
      if (row && (together.empty() || together.back() != *row)) together.push_back(*row);
    }
    expect_all();
  }
  for (const Tie& tie : terms.ties) {
    together.clear();
    for (std::size_t b = 0; b < tie.count; ++b) {
      if (tie.rows[b]) together.push_back(*tie.rows[b]);
    }
    expect_all();
  }
  points_.reserve(terms.first.size() - 1);
}

void ReducedSystem::linearise(double damping) {
  matrix_.clear();
  gradient_.assign(terms_.rows.size(), Vector6d::Zero());
  diagonal_ = gradient_;
  points_.clear();
  const std::vector<Pose> poses = chain_of(terms_);
  for (std::size_t p = 0; p + 1 < terms_.first.size(); ++p) eliminate(p, poses, damping);
  for (const Tie& tie : terms_.ties) add(tie);
  damp(damping);
}

void ReducedSystem::eliminate(std::size_t p, const std::vector<Pose>& poses, double damping) {
  const Eigen::Vector3d point(terms_.unknowns->points[p]);
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  crosses_.clear();
  crossed_.clear();
  for (std::size_t s = terms_.first[p]; s < terms_.first[p + 1]; ++s) {
    const auto& [sight, pose] = terms_.sights[s];
    const Sights::Linearised at = terms_.unknowns->factors->linearise(sight, poses[pose], point);
    own.noalias() += at.by_point.transpose() * at.by_point;
    gradient.noalias() += at.by_point.transpose() * at.residual;
    if (!terms_.row_of[pose]) continue;
    const std::size_t row = *terms_.row_of[pose];
    const Matrix6d of_pose = at.by_pose.transpose() * at.by_pose;
    matrix_.at(row, row) += of_pose;
    diagonal_[row] += of_pose.diagonal();
    gradient_[row].noalias() += at.by_pose.transpose() * at.residual;
    if (crossed_.empty() || crossed_.back() != row) {
      crossed_.push_back(row);
      crosses_.push_back(Cross::Zero());
    }
    crosses_.back().noalias() += at.by_pose.transpose() * at.by_point;
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
  }
  points_.push_back({inverse, gradient});
}

void ReducedSystem::add(const Tie& tie) {
  using Jacobian = Eigen::Matrix<double, kResiduals, 6>;
  Vector6d residuals = Vector6d::Zero();
  std::array<std::array<double, kResiduals * kNumbers>, Tie::kMostBlocks> values{};
  std::array<double*, Tie::kMostBlocks> pointers{};
  for (std::size_t b = 0; b < tie.count; ++b)
    pointers[b] = tie.rows[b] ? values[b].data() : nullptr;
  tie.factor->Evaluate(tie.blocks.data(), residuals.data(), pointers.data());
  const double scale = weigh(tie.loss, residuals.squaredNorm()).scale;
  residuals *= scale;
  std::array<Jacobian, Tie::kMostBlocks> jacobians;
  for (std::size_t b = 0; b < tie.count; ++b) {
    if (!tie.rows[b]) continue;
    const std::size_t row = *tie.rows[b];
    const Row& unknown = terms_.rows[row];
    jacobians[b].setZero();
    for (int r = 0; r < tie.factor->num_residuals(); ++r) {
      for (int c = 0; c < unknown.tangent(); ++c) {
        jacobians[b](r, c) = scale * values[b][static_cast<std::size_t>(r * unknown.size + c)];
      }
    }
    gradient_[row].noalias() += jacobians[b].transpose() * residuals;
    diagonal_[row] += jacobians[b].colwise().squaredNorm().transpose();
    for (std::size_t other = 0; other <= b; ++other) {
      if (!tie.rows[other]) continue;
      const std::size_t column = *tie.rows[other];
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
  const std::vector<Pose> poses = chain_of(terms_);
  std::vector<Eigen::Vector3d> of_points;
  of_points.reserve(points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Eigen::Vector3d point(terms_.unknowns->points[p]);
    Eigen::Vector3d pull = points_[p].gradient;
    for (std::size_t s = terms_.first[p]; s < terms_.first[p + 1]; ++s) {
      const auto& [sight, pose] = terms_.sights[s];
      if (!terms_.row_of[pose]) continue;
      const Sights::Linearised at = terms_.unknowns->factors->linearise(sight, poses[pose], point);
      pull.noalias() += at.by_point.transpose() * (at.by_pose * steps[*terms_.row_of[pose]]);
    }
    of_points.push_back(-(points_[p].inverse * pull));
  }
  return of_points;
}

}  // namespace vinebench::slam
