// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/calibration_watch.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vinebench::slam {
namespace {

constexpr std::size_t kPart = 12;  // keyframes
constexpr int kIterations = 8;

/// The first look is at the first keyframes. What they say is not added up: the dozen has it too.
constexpr std::size_t kFirstKeyframes = 6;

/// Once so many dozens have been looked at, beside the first keyframes, every fourth is enough.
constexpr int kFrequentLooks = 9;
constexpr std::size_t kLaterLooks = 48;  // keyframes

/// Landmarks that fewer keyframes of a part see say too little of the calibrations for the time
/// that they cost.
constexpr int kMinKeyframes = 3;

/// Numbers that covariances are trusted for beforehand, to estimate how far they are right.
constexpr double kTrustedFreedom = 12;

/// Share of the accuracy to which numbers are held that are not to be estimated.
constexpr double kExact = 1e-3;

/// Nothing bears out what one pair alone shows of itself, and what its images and the model of them
/// differ in looks like a calibration: on a real drive like 0.3 px that the truth does not have.
constexpr double kLeastOfOnePair = 0.9;  // px

/// Quantiles of the normal distribution: what happens by chance once in a thousand and in ten
/// thousand looks. The first of these probabilities besides.
constexpr double kSeldom = 1e-3;
constexpr double kThousandth = 3.09;
constexpr double kTenThousandth = 3.72;

AdjustmentWindow keyframes_between(std::size_t begin, std::size_t end) {
  AdjustmentWindow window;
  window.fixed.push_back(static_cast<int>(begin));
  for (std::size_t id = begin + 1; id < end; ++id) window.moved.push_back(static_cast<int>(id));
  return window;
}

CalibrationBelief nothing_of(const EstimatorRig& rig) {
  return CalibrationBelief::nothing(rig.rig.pairs.size(), rig.rig.tag_cameras.size());
}

/// The rig file's accuracy.
CalibrationBelief belief_of(const CalibrationConfig& accuracy, double disparity_sigma,
                            const EstimatorRig& rig) {
  Eigen::Matrix<double, kPairUnknowns, 1> pair;
  pair << Eigen::Vector3d::Constant(accuracy.position),
      Eigen::Vector3d::Constant(accuracy.rotation_deg * std::numbers::pi / 180), disparity_sigma,
      accuracy.disparity_slope, accuracy.focal, accuracy.baseline, accuracy.time, accuracy.readout,
      Eigen::Vector2d::Constant(accuracy.principal_point),
      Eigen::Vector3d::Constant(accuracy.right_turn_deg * std::numbers::pi / 180),
      accuracy.right_ahead;
  const auto pairs = static_cast<Eigen::Index>(rig.rig.pairs.size());
  const auto tag_cameras = static_cast<Eigen::Index>(rig.rig.tag_cameras.size());
  Eigen::VectorXd sigma(pairs * kPairUnknowns + tag_cameras);
  sigma << pair.replicate(pairs, 1),
      Eigen::VectorXd::Constant(tag_cameras, accuracy.tag_camera_time);
  if (pairs == 1) {
    sigma *= kExact;
    sigma[PairNumber::kDisparityOffset] = disparity_sigma;
  }
  CalibrationBelief belief = nothing_of(rig);
  belief.information.diagonal() = sigma.cwiseAbs2().cwiseInverse();
  return belief;
}

/// Chi-square of so many degrees of freedom at a quantile of the normal distribution, after Wilson
/// and Hilferty, "The distribution of chi-square" (1931).
double chi_squared_at(double normal_quantile, double freedom) {
  const double spread = 2 / (9 * freedom);
  return freedom * std::pow(1 - spread + normal_quantile * std::sqrt(spread), 3);
}

/// Squared distance of what two beliefs say, in standard deviations of their difference. `part` may
/// say nothing of some numbers, `known` must say something of all.
double distance_squared(const CalibrationBelief& part, const CalibrationBelief& known,
                        const CalibrationBelief& prior) {
  const CalibrationBelief sure = part + prior * 1e-3;
  const Eigen::VectorXd difference =
      sure.information.ldlt().solve(part.information_vector - part.information * known.mean());
  const Eigen::MatrixXd covariance = sure.covariance() + known.covariance();
  return difference.dot(covariance.ldlt().solve(difference));
}

/// How many numbers a part tells more of than the rig file does.
double freedom_of(const CalibrationBelief& part, const CalibrationBelief& prior) {
  return (part + prior).information.ldlt().solve(part.information).trace();
}

/// How much less likely a calibration is than the belief's mean: the difference of their
/// chi-squares.
double unlikeliness(const CalibrationBelief& belief, const Eigen::VectorXd& calibration) {
  const Eigen::VectorXd difference = calibration - belief.mean();
  return difference.dot(belief.information * difference);
}

}  // namespace

CalibrationWatch::CalibrationWatch(const CalibrationConfig& accuracy, double disparity_sigma,
                                   const EstimatorRig& rig)
    : accuracy_(accuracy),
      pairs_(rig.rig.pairs.size()),
      prior_(belief_of(accuracy, disparity_sigma, rig)),
      parts_(nothing_of(rig)),
      average_(average(prior_, prior_, pairs_)),
      drift_(Eigen::MatrixXd::Zero(6, prior_.information.cols())) {}

bool CalibrationWatch::due(const Map& map) const {
  const std::size_t more =
      looks_ == 0 ? kFirstKeyframes : (looks_ < kFrequentLooks ? kPart : kLaterLooks);
  return map.keyframes().size() >= looked_ + more;
}

std::optional<RigCalibration> CalibrationWatch::look(const Map& map, const EstimatorRig& rig,
                                                     const AdjustmentOptions& options) {
  const auto part = begin_look(map, rig, options);
  part->solve();
  return finish_look(part->calibration(), rig);
}

std::unique_ptr<AdjustmentJob> CalibrationWatch::begin_look(const Map& map, const EstimatorRig& rig,
                                                            const AdjustmentOptions& options) {
  if (looks_++ == 0) return job(kFirstKeyframes, map, rig, options);
  looked_ = map.keyframes().size();
  return job(kPart, map, rig, options);
}

std::optional<RigCalibration> CalibrationWatch::finish_look(const CalibrationMarginal& found,
                                                            const EstimatorRig& rig) {
  const CalibrationBelief part = found.belief + prior_ * -1;
  if (!part.information.allFinite() || !part.information_vector.allFinite()) return std::nullopt;
  const bool first = looks_ == 1;
  keep_drift(found, first ? kFirstKeyframes : kPart);
  if (!first) add(part);
  const CalibrationBelief now = first ? prior_ + part : known();
  average_ = average(now, prior_, pairs_);
  if (pairs_ == 1) return first ? std::nullopt : look_at_one_pair(now, rig);
  const Eigen::VectorXd& better = average_.mean;
  const double gain = unlikeliness(now, to_vector(rig.calibration)) - unlikeliness(now, better);
  if (average_.file_is_right > kSeldom ||
      gain < chi_squared_at(kThousandth, std::max(1.0, average_.numbers_at_work))) {
    return std::nullopt;
  }
  replaced_ = true;
  return from_vector(better, pairs_);
}

std::optional<RigCalibration> CalibrationWatch::look_at_one_pair(const CalibrationBelief& now,
                                                                 const EstimatorRig& rig) {
  if (replaced_) return std::nullopt;
  Eigen::VectorXd better = Eigen::VectorXd::Zero(now.information_vector.size());
  better[PairNumber::kDisparityOffset] =
      now.information_vector[PairNumber::kDisparityOffset] /
      now.information(PairNumber::kDisparityOffset, PairNumber::kDisparityOffset);
  const double gain = unlikeliness(now, to_vector(rig.calibration)) - unlikeliness(now, better);
  const double change =
      better[PairNumber::kDisparityOffset] - rig.calibration.pairs.front().disparity_offset;
  if (std::abs(change) < kLeastOfOnePair || gain < chi_squared_at(kThousandth, 1)) {
    return std::nullopt;
  }
  replaced_ = true;
  return from_vector(better, pairs_);
}

std::optional<RigCalibration> CalibrationWatch::latest() const {
  if (!replaced_ || pairs_ == 1) return std::nullopt;
  return from_vector(average_.mean, pairs_);
}

std::unique_ptr<AdjustmentJob> CalibrationWatch::job(std::size_t keyframes, const Map& map,
                                                     const EstimatorRig& rig,
                                                     const AdjustmentOptions& options) const {
  AdjustmentOptions unknown = options;
  unknown.iterations = kIterations;
  // As a part of the map their corners, which err alike from frame to frame, say too much.
  unknown.tags = false;
  unknown.tag_measures =
      TagAccuracy{accuracy_.tag_size, options.tag_corner_sigma, accuracy_.tag_camera_position,
                  accuracy_.tag_camera_rotation_deg};
  unknown.min_keyframes = kMinKeyframes;
  unknown.calibration = prior_;
  const std::size_t end = map.keyframes().size();
  return std::make_unique<AdjustmentJob>(map, keyframes_between(end - keyframes, end), rig,
                                         unknown);
}

void CalibrationWatch::keep_drift(const CalibrationMarginal& marginal, std::size_t keyframes) {
  if (!marginal.of_last_pose.allFinite()) return;
  drift_ = marginal.of_last_pose / static_cast<double>(keyframes - 1);
  for (Eigen::Index pair = 0; pair < static_cast<Eigen::Index>(pairs_); ++pair) {
    drift_.col(pair * kPairUnknowns + PairNumber::kTime).setZero();
    drift_.col(pair * kPairUnknowns + PairNumber::kReadout).setZero();
  }
}

void CalibrationWatch::add(const CalibrationBelief& part) {
  const bool first = freedom_ == 0 && parts_.information.isZero();
  if (!first) {
    const double freedom = freedom_of(part, prior_);
    const double limit = chi_squared_at(kTenThousandth, std::max(1.0, freedom));
    const double distance = distance_to(parts_, part);
    if (distance <= limit) {
      chi_squared_ += distance * spread();
      freedom_ += freedom;
    } else if (!stranger_ || distance_to(*stranger_, part) > limit) {
      stranger_ = part;
      return;
    } else {
      parts_ = *stranger_;
      chi_squared_ = freedom_ = 0;
    }
  }
  stranger_.reset();
  parts_ = parts_ + part;
}

/// Squared, of what a part says from what the rig file and these say.
double CalibrationWatch::distance_to(const CalibrationBelief& others,
                                     const CalibrationBelief& part) const {
  const double share = 1 / spread();
  return distance_squared(part * share, prior_ + others * share, prior_);
}

/// Factor of the variances that the parts' own say.
double CalibrationWatch::spread() const {
  return std::max(1.0, (kTrustedFreedom + chi_squared_) / (kTrustedFreedom + freedom_));
}

CalibrationBelief CalibrationWatch::known() const {
  return prior_ + parts_ * (1 / spread());
}

Eigen::MatrixXd CalibrationWatch::error(const EstimatorRig& rig) const {
  const Eigen::VectorXd missed = average_.mean - to_vector(rig.calibration);
  return average_.covariance + missed * missed.transpose();
}

}  // namespace vinebench::slam
