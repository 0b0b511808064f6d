// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/calibration_unknowns.h"

#include <algorithm>

namespace vinebench::slam {
namespace {

std::vector<Pose> nominal_cameras(const EstimatorRig& rig) {
  std::vector<Pose> cameras;
  for (const RectifiedPair& pair : rig.rig.pairs) cameras.push_back(pair.T_body_cam);
  return cameras;
}

}  // namespace

CalibrationUnknowns::CalibrationUnknowns(const EstimatorRig& rig, const CalibrationBelief& belief)
    : T_body_nominal_(nominal_cameras(rig)),
      factor_(T_body_nominal_, belief),
      tag_times_(rig.calibration.tag_times) {
  for (std::size_t v = 0; v < rig.calibration.pairs.size(); ++v) {
    cameras_.push_back(to_block(rig.T_body_cams[v]));
    const Eigen::VectorXd numbers = to_vector({{rig.calibration.pairs[v]}, {}});
    Lens& lens = lenses_.emplace_back();
    std::copy_n(numbers.data() + PairNumber::kDisparityOffset, kLensUnknowns, lens.begin());
  }
}

void CalibrationUnknowns::add_to(ProblemBuilder& problem, const Map&) {
  std::vector<double*> blocks;
  for (std::size_t v = 0; v < cameras_.size(); ++v) {
    problem.add_pose(camera(v), ProblemBuilder::Group::kCameras);
    problem.add_block(lens(v), kLensUnknowns, ProblemBuilder::Group::kLenses);
    blocks.push_back(camera(v));
    blocks.push_back(lens(v));
  }
  for (double& time : tag_times_) {
    problem.add_block(&time, 1, ProblemBuilder::Group::kTagTimes);
    blocks.push_back(&time);
  }
  problem.add_factor(factor_, nullptr, blocks);
}

RigCalibration CalibrationUnknowns::found() const {
  RigCalibration rig{{}, tag_times_};
  for (std::size_t v = 0; v < cameras_.size(); ++v) {
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(kPairUnknowns);
    std::ranges::copy(lenses_[v], numbers.data() + PairNumber::kDisparityOffset);
    rig.pairs.push_back(from_vector(numbers, 1).pairs.front());
    rig.pairs.back().T_nominal_camera =
        T_body_nominal_[v].inverse() * from_block(cameras_[v].data());
  }
  return rig;
}

CalibrationMarginal CalibrationUnknowns::marginal(ProblemBuilder& problem) const {
  // Of all cameras, then of all lenses; to_vector() has them pair by pair.
  const ProblemBuilder::Marginal by_group =
      problem.marginal({ProblemBuilder::Group::kCameras, ProblemBuilder::Group::kLenses,
                        ProblemBuilder::Group::kTagTimes});
  const auto pairs = static_cast<Eigen::Index>(cameras_.size());
  std::vector<Eigen::Index> source;
  for (Eigen::Index v = 0; v < pairs; ++v) {
    for (Eigen::Index i = 0; i < 6; ++i) source.push_back(6 * v + i);
    for (Eigen::Index i = 0; i < kLensUnknowns; ++i) {
      source.push_back(6 * pairs + kLensUnknowns * v + i);
    }
  }
  while (static_cast<Eigen::Index>(source.size()) < by_group.information.cols()) {
    source.push_back(static_cast<Eigen::Index>(source.size()));
  }
  CalibrationBelief belief{by_group.information(source, source), {}};
  belief.information_vector = belief.information * to_vector(found());
  return {belief, by_group.of_last_pose(Eigen::all, source)};
}

}  // namespace vinebench::slam
