// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/geometry/cross_matrix.h"
#include "core/util/random.h"
#include "slam/factors/pose_manifold.h"
#include "slam/solver/terms.h"

namespace vinebench::test {

/// Where a body sees a point, in its own frame, in units of its noise.
class PlaceFactor : public ceres::CostFunction {
 public:
  PlaceFactor(Eigen::Vector3d seen, double sigma) : seen_(std::move(seen)), sigma_(sigma) {
    set_num_residuals(3);
    *mutable_parameter_block_sizes() = {7, 3};
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Pose T_map_body = slam::from_block(blocks[0]);
    const Eigen::Matrix3d R_body_map = T_map_body.rotation.toRotationMatrix().transpose();
    const Eigen::Vector3d point =
        R_body_map * (Eigen::Map<const Eigen::Vector3d>(blocks[1]) - T_map_body.translation);
    Eigen::Map<Eigen::Vector3d>{residuals} = (point - seen_) / sigma_;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> J(jacobians[0]);
      J << -Eigen::Matrix3d::Identity() / sigma_, cross_matrix(point) / sigma_,
          Eigen::Vector3d::Zero();
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> J(jacobians[1]);
      J = R_body_map / sigma_;
    }
    return true;
  }

 private:
  Eigen::Vector3d seen_;
  double sigma_;
};

/// Bodies once around a circle, who see the points near them to 1 cm; the first stands still. The
/// blocks are where bodies and points truly are.
struct LoopProblem : slam::Sights {
  static constexpr double kRadius = 5;    // m
  static constexpr double kReach = 1.5;   // m
  static constexpr double kSigma = 0.01;  // m

  LoopProblem(std::size_t bodies, std::size_t count, double noise,
              ceres::LossFunction* loss_of_sights = nullptr)
      : poses(bodies), points(count), loss(loss_of_sights), problem(ownership()), all(ownership()) {
    RandomSequence random(RandomStream(1, "loop"));
    const auto draw = [&]() -> Eigen::Vector3d {
      return {random.normal(), random.normal(), random.normal()};
    };
    const auto on_circle = [](double share) -> Eigen::Vector3d {
      const double angle = 2 * std::numbers::pi * share;
      return {kRadius * std::cos(angle), kRadius * std::sin(angle), 0};
    };
    for (std::size_t i = 0; i < bodies; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(bodies);
      poses[i] = slam::to_block(
          {exp_so3({0.01 * random.normal(), 0, 2 * std::numbers::pi * share}), on_circle(share)});
      unknowns.poses.push_back(poses[i].data());
      for (ceres::Problem* of : {&problem, &all}) {
        of->AddParameterBlock(poses[i].data(), 7, &manifold);
      }
    }
    for (ceres::Problem* of : {&problem, &all}) of->SetParameterBlockConstant(poses[0].data());
    for (std::size_t p = 0; p < count; ++p) {
      points[p] = on_circle(static_cast<double>(p) / static_cast<double>(count)) + 0.3 * draw();
      unknowns.points.push_back(points[p].data());
      all.AddParameterBlock(points[p].data(), 3);
      for (std::size_t i = 0; i < bodies; ++i) {
        const Pose T_map_body = slam::from_block(poses[i].data());
        if ((points[p] - T_map_body.translation).norm() > kReach) continue;
        factors.push_back(std::make_unique<PlaceFactor>(
            T_map_body.inverse() * points[p] + noise * draw(), kSigma));
        all.AddResidualBlock(factors.back().get(), loss, poses[i].data(), points[p].data());
        unknowns.sights.push_back({static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(i)});
      }
    }
    unknowns.chain = bodies;
    unknowns.factors = this;
  }

  double cost(std::size_t sight, const Pose& T_map_body,
              const Eigen::Vector3d& p_map) const override {
    const slam::PoseBlock pose = slam::to_block(T_map_body);
    const std::array<const double*, 2> blocks{pose.data(), p_map.data()};
    Eigen::Vector3d residual;
    factors[sight]->Evaluate(blocks.data(), residual.data(), nullptr);
    return slam::weigh(loss, residual.squaredNorm()).cost;
  }

  Linearised linearise(std::size_t sight, const Pose& T_map_body,
                       const Eigen::Vector3d& p_map) const override {
    const slam::PoseBlock pose = slam::to_block(T_map_body);
    const std::array<const double*, 2> blocks{pose.data(), p_map.data()};
    Eigen::Vector3d residual;
    Eigen::Matrix<double, 3, 7, Eigen::RowMajor> by_block;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_point;
    std::array<double*, 2> jacobians{by_block.data(), by_point.data()};
    factors[sight]->Evaluate(blocks.data(), residual.data(), jacobians.data());
    const double scale = slam::weigh(loss, residual.squaredNorm()).scale;
    return {scale * residual, scale * by_block.leftCols<6>(), scale * by_point};
  }

  /// A factor of poses, for both ways of solving.
  void tie(ceres::CostFunction& factor, const std::vector<double*>& blocks) {
    for (ceres::Problem* of : {&problem, &all}) of->AddResidualBlock(&factor, nullptr, blocks);
  }

  /// Moves all but the first body by about so many metres and a tenth of a radian for each.
  void perturb(double amount) {
    RandomSequence random(RandomStream(2, "perturb"));
    for (std::size_t i = 1; i < poses.size(); ++i) {
      Vector6d step;
      for (double& s : step) s = amount * random.normal();
      step.tail<3>() *= 0.1;
      poses[i] = slam::to_block(slam::from_block(poses[i].data()) * step_of(step));
    }
    for (Eigen::Vector3d& point : points) {
      for (double& x : point) x += amount * random.normal();
    }
  }

  /// As Ceres has it.
  double whole_cost() {
    double cost = 0;
    all.Evaluate({}, &cost, nullptr, nullptr, nullptr);
    return cost;
  }

  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  std::vector<slam::PoseBlock> poses;
  std::vector<Eigen::Vector3d> points;
  ceres::LossFunction* loss;
  std::vector<std::unique_ptr<ceres::CostFunction>> factors;
  slam::PoseManifold manifold;
  slam::Unknowns unknowns;
  ceres::Problem problem;  ///< the bodies alone
  ceres::Problem all;      ///< with points and factors of these
};

}  // namespace vinebench::test
