// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/pose_chain.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/geometry/step_covariance.h"
#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

/// How sure the first pose is: enough for inverses to exist.
constexpr double kFirstOffset = 1e-6;  // m
constexpr double kFirstTurn = 1e-6;    // rad

constexpr double kShortestStep = 0.01;  // m; a turn on the spot is uncertain too

/// P after a measurement of that information: (P^-1 + M)^-1, without inverting a P near zero.
Matrix6d measured_by(const Matrix6d& P, const Matrix6d& M) {
  const Matrix6d gain = (Matrix6d::Identity() + P * M).partialPivLu().solve(P);
  return 0.5 * (gain + gain.transpose());
}

}  // namespace

PoseChain::PoseChain(const std::vector<Pose>& poses, const OdometryDrift& drift) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (k == 0) {
      carried_.emplace_back(Matrix6d::Identity());
      noise_.emplace_back(isotropic_covariance(kFirstOffset, kFirstTurn));
      continue;
    }
    const Pose T_before_now = poses[k - 1].inverse() * poses[k];
    const double root = std::sqrt(std::max(T_before_now.translation.norm(), kShortestStep));
    carried_.push_back(carried_step(T_before_now));
    noise_.push_back(isotropic_covariance(drift.offset * root, drift.turn * root));
  }
}

double PoseChain::information(const std::vector<Matrix6d>& measured) const {
  double nats = 0;
  Matrix6d P = Matrix6d::Zero();
  for (std::size_t k = 0; k < size(); ++k) {
    P = carried_[k] * P * carried_[k].transpose() + noise_[k];
    if (measured[k].isZero(0)) continue;
    nats += 0.5 * std::log((Matrix6d::Identity() + P * measured[k]).determinant());
    P = measured_by(P, measured[k]);
  }
  return nats;
}

std::vector<double> PoseChain::position_errors(const std::vector<Matrix6d>& measured) const {
  std::vector<Matrix6d> predicted(size());
  std::vector<Matrix6d> filtered(size());
  Matrix6d P = Matrix6d::Zero();
  for (std::size_t k = 0; k < size(); ++k) {
    predicted[k] = carried_[k] * P * carried_[k].transpose() + noise_[k];
    filtered[k] = P = measured[k].isZero(0) ? predicted[k] : measured_by(predicted[k], measured[k]);
  }
  std::vector<double> errors(size());
  for (std::size_t k = size(); k-- > 0;) {
    if (k + 1 < size()) {
      const Matrix6d gain =
          predicted[k + 1].ldlt().solve(carried_[k + 1] * filtered[k]).transpose();
      P = filtered[k] + gain * (P - predicted[k + 1]) * gain.transpose();
    }
    errors[k] = std::sqrt(std::max(0.0, P.topLeftCorner<3, 3>().trace()));
  }
  return errors;
}

double share_of(std::vector<double> errors, double share) {
  return percentile(std::move(errors), share);
}

}  // namespace vinebench::harness
