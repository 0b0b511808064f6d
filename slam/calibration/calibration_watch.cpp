// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/calibration_watch.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slam/optimisation/pose_uncertainty.h"

namespace vinebench::slam {
namespace {

constexpr std::size_t kPart = 12;  // keyframes
constexpr int kIterations = 8;

/// Once so many dozens have been looked at, every fourth is enough.
constexpr int kFrequentLooks = 8;
constexpr std::size_t kLaterLooks = 48;  // keyframes

/// Landmarks that fewer keyframes of a part see say too little of the calibrations for the time
/// that they cost.
constexpr int kMinKeyframes = 3;

/// Times as surely as by the rig's accuracy the pairs are held not to move all together.
constexpr double kHeldTogether = 1e4;

/// Numbers that covariances are trusted for beforehand, to estimate how far they are right.
constexpr double kTrustedFreedom = 12;

constexpr Eigen::Index kDisparityOffset = 6;

/// Share of the accuracy to which numbers are held that are not to be estimated.
constexpr double kExact = 1e-3;

/// Nothing bears out what one pair alone shows of itself, and what its images and the model of them
/// differ in looks like a calibration: on a real drive like 0.3 px that the truth does not have.
constexpr double kLeastOfOnePair = 0.9;  // px

/// Quantiles of the normal distribution: what happens by chance once in a hundred, a thousand and
/// ten thousand looks.
constexpr double kHundredth = 2.33;
constexpr double kThousandth = 3.09;
constexpr double kTenThousandth = 3.72;

AdjustmentWindow keyframes_between(std::size_t begin, std::size_t end) {
  AdjustmentWindow window;
  window.fixed.push_back(static_cast<int>(begin));
  for (std::size_t id = begin + 1; id < end; ++id) window.moved.push_back(static_cast<int>(id));
  return window;
}

/// The steps of all cameras that a step of the body (columns) makes of them: moved together, they
/// see the same.
Eigen::MatrixXd moves_together(const EstimatorRig& rig) {
  const auto pairs = static_cast<Eigen::Index>(rig.rig.pairs.size());
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(kPairUnknowns * pairs, 6);
  for (Eigen::Index v = 0; v < pairs; ++v) {
    moves.middleRows<6>(kPairUnknowns * v) =
        carried_step(rig.rig.pairs[static_cast<std::size_t>(v)].T_body_cam);
  }
  return moves;
}

/// The rig file's accuracy. That the pairs are not moved all together is a matter of definition,
/// since that is no more than another body frame.
CalibrationBelief belief_of(const CalibrationConfig& accuracy, double disparity_sigma,
                            const EstimatorRig& rig) {
  Eigen::Matrix<double, kPairUnknowns, 1> sigma;
  sigma << Eigen::Vector3d::Constant(accuracy.position),
      Eigen::Vector3d::Constant(accuracy.rotation_deg * std::numbers::pi / 180), disparity_sigma,
      accuracy.disparity_slope, accuracy.focal, accuracy.baseline, accuracy.time, accuracy.readout;
  if (rig.rig.pairs.size() == 1) {
    sigma *= kExact;
    sigma[kDisparityOffset] = disparity_sigma;
  }
  CalibrationBelief belief = CalibrationBelief::nothing(rig.rig.pairs.size());
  belief.information.diagonal() = sigma.cwiseAbs2().cwiseInverse().replicate(
      static_cast<Eigen::Index>(rig.rig.pairs.size()), 1);
  const Eigen::MatrixXd held = belief.information * moves_together(rig);
  const Eigen::MatrixXd weight = (moves_together(rig).transpose() * held).inverse();
  belief.information += kHeldTogether * held * weight * held.transpose();
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

/// Numbers that differ from the rig file together.
using Cause = std::vector<Eigen::Index>;

/// What may be wrong with a rig of so many unknowns. Of places, directions, times and baselines a
/// drive shows by how much the pairs differ from each other, seldom which of them it is: they are
/// wrong for all pairs or for none.
std::vector<Cause> possible_causes(Eigen::Index unknowns) {
  const auto of_all_pairs = [unknowns](Eigen::Index first, Eigen::Index count) {
    Cause cause;
    for (Eigen::Index pair = 0; pair < unknowns; pair += kPairUnknowns) {
      for (Eigen::Index i = first; i < first + count; ++i) cause.push_back(pair + i);
    }
    return cause;
  };
  std::vector<Cause> causes{of_all_pairs(0, 3), of_all_pairs(3, 3), of_all_pairs(9, 1),
                            of_all_pairs(10, 1)};
  for (Eigen::Index pair = 0; pair < unknowns; pair += kPairUnknowns) {
    for (const Eigen::Index number : {6, 7, 8, 11}) causes.push_back({pair + number});
  }
  return causes;
}

/// The mean of a belief where these numbers alone differ from the rig file.
Eigen::VectorXd mean_of(const CalibrationBelief& belief, const std::vector<Eigen::Index>& free) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(belief.information_vector.size());
  if (free.empty()) return mean;
  const Eigen::MatrixXd information = belief.information(free, free);
  const Eigen::VectorXd vector = belief.information_vector(free);
  mean(free) = information.ldlt().solve(vector).eval();
  return mean;
}

/// How much less likely a calibration is than the belief's mean: the difference of their
/// chi-squares.
double unlikeliness(const CalibrationBelief& belief, const Eigen::VectorXd& calibration) {
  const Eigen::VectorXd difference = calibration - belief.mean();
  return difference.dot(belief.information * difference);
}

std::vector<Eigen::Index> numbers_of(const std::vector<Cause>& causes) {
  std::vector<Eigen::Index> numbers;
  for (const Cause& cause : causes) numbers.insert(numbers.end(), cause.begin(), cause.end());
  return numbers;
}

/// The likeliest calibration after the rig file's, with as few causes as explain it: one after the
/// other goes that is missed least, while chance alone explains what is missed.
Eigen::VectorXd simplest(const CalibrationBelief& belief) {
  std::vector<Cause> causes = possible_causes(belief.information.rows());
  Eigen::VectorXd found = mean_of(belief, numbers_of(causes));
  while (!causes.empty()) {
    const double now = unlikeliness(belief, found);
    double least = std::numeric_limits<double>::infinity();
    std::size_t dispensable = 0;
    Eigen::VectorXd without;
    for (std::size_t c = 0; c < causes.size(); ++c) {
      std::vector<Cause> others = causes;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(c));
      const Eigen::VectorXd mean = mean_of(belief, numbers_of(others));
      const double missed = (unlikeliness(belief, mean) - now) /
                            chi_squared_at(kHundredth, static_cast<double>(causes[c].size()));
      if (missed >= least) continue;
      least = missed;
      dispensable = c;
      without = mean;
    }
    if (least > 1) break;
    causes.erase(causes.begin() + static_cast<std::ptrdiff_t>(dispensable));
    found = without;
  }
  return found;
}

}  // namespace

CalibrationWatch::CalibrationWatch(const CalibrationConfig& accuracy, double disparity_sigma,
                                   const EstimatorRig& rig)
    : prior_(belief_of(accuracy, disparity_sigma, rig)),
      parts_(CalibrationBelief::nothing(rig.rig.pairs.size())),
      drift_(Eigen::MatrixXd::Zero(6, prior_.information.cols())) {}

bool CalibrationWatch::due(const Map& map) const {
  return map.keyframes().size() >= looked_ + (looks_ < kFrequentLooks ? kPart : kLaterLooks);
}

std::optional<std::vector<PairCalibration>> CalibrationWatch::look(
    const Map& map, const EstimatorRig& rig, const AdjustmentOptions& options) {
  const auto [part, of_last_pose] = measure(map, rig, options);
  looked_ = map.keyframes().size();
  ++looks_;
  if (!part.information.allFinite() || !part.information_vector.allFinite()) return std::nullopt;
  if (of_last_pose.allFinite()) drift_ = of_last_pose / static_cast<double>(kPart - 1);
  add(part);
  const CalibrationBelief now = known();
  if (rig.calibration.size() == 1) return look_at_one_pair(now, rig);
  const Eigen::VectorXd better = simplest(now);
  const double gain = unlikeliness(now, to_vector(rig.calibration)) - unlikeliness(now, better);
  if (gain < chi_squared_at(kThousandth, static_cast<double>(better.size()))) return std::nullopt;
  replaced_ = true;
  return from_vector(better);
}

std::optional<std::vector<PairCalibration>> CalibrationWatch::look_at_one_pair(
    const CalibrationBelief& now, const EstimatorRig& rig) {
  if (replaced_) return std::nullopt;
  const Eigen::VectorXd better = mean_of(now, {kDisparityOffset});
  const double gain = unlikeliness(now, to_vector(rig.calibration)) - unlikeliness(now, better);
  const double change = better[kDisparityOffset] - rig.calibration.front().disparity_offset;
  if (std::abs(change) < kLeastOfOnePair || gain < chi_squared_at(kThousandth, 1)) {
    return std::nullopt;
  }
  replaced_ = true;
  return from_vector(better);
}

std::optional<std::vector<PairCalibration>> CalibrationWatch::latest() const {
  if (!replaced_ || prior_.information.rows() == kPairUnknowns) return std::nullopt;
  return from_vector(simplest(known()));
}

CalibrationMarginal CalibrationWatch::measure(const Map& map, const EstimatorRig& rig,
                                              const AdjustmentOptions& options) const {
  AdjustmentOptions unknown = options;
  unknown.iterations = kIterations;
  unknown.tags = false;  // their corners err alike from frame to frame, by more than they tell
  unknown.min_keyframes = kMinKeyframes;
  unknown.calibration = prior_;
  const std::size_t end = map.keyframes().size();
  AdjustmentJob job(map, keyframes_between(end - kPart, end), rig, unknown);
  job.solve();
  CalibrationMarginal found = job.calibration();
  found.belief = found.belief + prior_ * -1;
  return found;
}

void CalibrationWatch::add(const CalibrationBelief& part) {
  const bool first = freedom_ == 0 && parts_.information.isZero();
  if (!first) {
    const double freedom = freedom_of(part, prior_);
    const double distance = distance_squared(part * (1 / spread()), known(), prior_);
    if (distance > chi_squared_at(kTenThousandth, std::max(1.0, freedom))) {
      if (!stranger_) {
        stranger_ = part;
        return;
      }
      parts_ = *stranger_;
      chi_squared_ = freedom_ = 0;
    } else {
      chi_squared_ += distance * spread();
      freedom_ += freedom;
    }
  }
  stranger_.reset();
  parts_ = parts_ + part;
}

/// Factor of the variances that the parts' own say.
double CalibrationWatch::spread() const {
  return std::max(1.0, (kTrustedFreedom + chi_squared_) / (kTrustedFreedom + freedom_));
}

CalibrationBelief CalibrationWatch::known() const {
  return prior_ + parts_ * (1 / spread());
}

Eigen::MatrixXd CalibrationWatch::error(const EstimatorRig& rig) const {
  const CalibrationBelief now = known();
  const Eigen::VectorXd missed = now.mean() - to_vector(rig.calibration);
  const double probability = replaced_ ? 1 : file_is_wrong(now);
  return probability * (now.covariance() + missed * missed.transpose());
}

/// By how much better a rig that is off by anything within the file's accuracy explains what was
/// seen than one that is as the file says (Bayes factor of two Gaussians), as a probability.
double CalibrationWatch::file_is_wrong(const CalibrationBelief& now) const {
  const auto log_determinant = [](const Eigen::MatrixXd& information) {
    return information.ldlt().vectorD().array().log().sum();
  };
  const double explained = now.information_vector.dot(now.mean());
  const double vagueness = log_determinant(now.information) - log_determinant(prior_.information);
  return 1 / (1 + std::exp(-0.5 * (explained - vagueness)));
}

}  // namespace vinebench::slam
