// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/calibration_belief.h"

#include <Eigen/Cholesky>

namespace vinebench::slam {

namespace {

Eigen::Index count_numbers(std::size_t pairs, std::size_t tag_cameras) {
  return kPairUnknowns * static_cast<Eigen::Index>(pairs) + static_cast<Eigen::Index>(tag_cameras);
}

}  // namespace

Eigen::VectorXd to_vector(const RigCalibration& rig) {
  Eigen::VectorXd unknowns(count_numbers(rig.pairs.size(), rig.tag_times.size()));
  Eigen::Index at = 0;
  for (const PairCalibration& pair : rig.pairs) {
    unknowns.segment<kPairUnknowns>(at) << pair.T_nominal_camera.translation,
        log_so3(pair.T_nominal_camera.rotation), pair.disparity_offset, pair.disparity_slope,
        pair.focal, pair.baseline, pair.time, pair.readout, pair.principal_point, pair.right_turn,
        pair.right_ahead;
    at += kPairUnknowns;
  }
  for (const double time : rig.tag_times) unknowns[at++] = time;
  return unknowns;
}

RigCalibration from_vector(const Eigen::VectorXd& unknowns, std::size_t pairs) {
  RigCalibration rig;
  Eigen::Index at = 0;
  for (; rig.pairs.size() < pairs; at += kPairUnknowns) {
    const auto numbers = unknowns.segment<kPairUnknowns>(at);
    rig.pairs.push_back(
        {step_of(numbers.head<6>()), numbers[PairNumber::kDisparityOffset],
         numbers[PairNumber::kDisparitySlope], numbers[PairNumber::kFocal],
         numbers[PairNumber::kBaseline], numbers[PairNumber::kTime], numbers[PairNumber::kReadout],
         numbers.segment<2>(PairNumber::kPrincipalPoint),
         numbers.segment<3>(PairNumber::kRightTurn), numbers[PairNumber::kRightAhead]});
  }
  rig.tag_times.assign(unknowns.begin() + at, unknowns.end());
  return rig;
}

CalibrationBelief CalibrationBelief::nothing(std::size_t pairs, std::size_t tag_cameras) {
  const Eigen::Index n = count_numbers(pairs, tag_cameras);
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
