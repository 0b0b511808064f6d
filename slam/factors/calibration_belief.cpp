// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/calibration_belief.h"

#include <Eigen/Cholesky>

namespace vinebench::slam {

Eigen::VectorXd to_vector(const std::vector<PairCalibration>& pairs) {
  Eigen::VectorXd unknowns(kPairUnknowns * static_cast<Eigen::Index>(pairs.size()));
  Eigen::Index at = 0;
  for (const PairCalibration& pair : pairs) {
    unknowns.segment<kPairUnknowns>(at) << pair.T_nominal_camera.translation,
        log_so3(pair.T_nominal_camera.rotation), pair.disparity_offset, pair.disparity_slope,
        pair.focal, pair.baseline, pair.time, pair.readout, pair.principal_point, pair.right_turn,
        pair.right_ahead;
    at += kPairUnknowns;
  }
  return unknowns;
}

std::vector<PairCalibration> from_vector(const Eigen::VectorXd& unknowns) {
  std::vector<PairCalibration> pairs;
  for (Eigen::Index at = 0; at < unknowns.size(); at += kPairUnknowns) {
    const auto numbers = unknowns.segment<kPairUnknowns>(at);
    pairs.push_back({step_of(numbers.head<6>()), numbers[PairNumber::kDisparityOffset],
                     numbers[PairNumber::kDisparitySlope], numbers[PairNumber::kFocal],
                     numbers[PairNumber::kBaseline], numbers[PairNumber::kTime],
                     numbers[PairNumber::kReadout], numbers.segment<2>(PairNumber::kPrincipalPoint),
                     numbers.segment<3>(PairNumber::kRightTurn), numbers[PairNumber::kRightAhead]});
  }
  return pairs;
}

CalibrationBelief CalibrationBelief::nothing(std::size_t pairs) {
  const Eigen::Index n = kPairUnknowns * static_cast<Eigen::Index>(pairs);
  return {Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
}

Eigen::VectorXd CalibrationBelief::mean() const {
  return information.ldlt().solve(information_vector);
}

Eigen::MatrixXd CalibrationBelief::covariance() const {
  return information.ldlt().solve(
      Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

}  // namespace vinebench::slam
