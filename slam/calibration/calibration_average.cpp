// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/calibration_average.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vinebench::slam {
namespace {

/// Of more pairs the numbers of all are wrong together: there were too many sets of causes.
constexpr Eigen::Index kMostPairsApart = 2;

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
  std::vector<Cause> causes{
      of_all_pairs(PairNumber::kPlace, 3), of_all_pairs(PairNumber::kDirection, 3),
      of_all_pairs(PairNumber::kBaseline, 1), of_all_pairs(PairNumber::kTime, 1)};
  for (const Eigen::Index number : {PairNumber::kDisparityOffset, PairNumber::kDisparitySlope,
                                    PairNumber::kFocal, PairNumber::kReadout}) {
    if (unknowns > kMostPairsApart * kPairUnknowns) {
      causes.push_back(of_all_pairs(number, 1));
      continue;
    }
    for (Eigen::Index pair = 0; pair < unknowns; pair += kPairUnknowns) {
      causes.push_back({pair + number});
    }
  }
  return causes;
}

std::vector<Eigen::Index> numbers_of(const std::vector<Cause>& causes, std::size_t set) {
  std::vector<Eigen::Index> numbers;
  for (std::size_t c = 0; c < causes.size(); ++c) {
    if ((set >> c & 1U) == 0) continue;
    numbers.insert(numbers.end(), causes[c].begin(), causes[c].end());
  }
  return numbers;
}

double log_determinant(const Eigen::LDLT<Eigen::MatrixXd>& of) {
  return of.vectorD().array().log().sum();
}

/// What a belief says where some numbers alone differ from the rig file.
struct Explanation {
  std::vector<Eigen::Index> numbers;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  double log_weight = 0;  ///< against the rig file as it is
};

Explanation explain_by(const CalibrationBelief& now, const CalibrationBelief& prior,
                       std::vector<Eigen::Index> numbers) {
  const Eigen::LDLT<Eigen::MatrixXd> information(now.information(numbers, numbers));
  const Eigen::LDLT<Eigen::MatrixXd> before(prior.information(numbers, numbers));
  const Eigen::VectorXd vector = now.information_vector(numbers);
  const auto count = static_cast<Eigen::Index>(numbers.size());
  const Eigen::VectorXd mean = information.solve(vector);
  const double log_evidence =
      0.5 * (vector.dot(mean) - log_determinant(information) + log_determinant(before));
  return {std::move(numbers), mean, information.solve(Eigen::MatrixXd::Identity(count, count)),
          log_evidence};
}

}  // namespace

CalibrationAverage average(const CalibrationBelief& now, const CalibrationBelief& prior) {
  const Eigen::Index size = now.information_vector.size();
  const std::vector<Cause> causes = possible_causes(size);
  const std::size_t sets = std::size_t{1} << causes.size();
  std::vector<Explanation> explanations;
  double most = 0;  // the rig file's own
  for (std::size_t set = 1; set < sets; ++set) {
    explanations.push_back(explain_by(now, prior, numbers_of(causes, set)));
    explanations.back().log_weight -= std::log(static_cast<double>(sets - 1));
    most = std::max(most, explanations.back().log_weight);
  }
  double sum = std::exp(-most);
  for (const Explanation& e : explanations) sum += std::exp(e.log_weight - most);

  CalibrationAverage found{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size),
                           std::exp(-most) / sum};
  Eigen::MatrixXd& moments = found.covariance;  // about the rig file, at first
  for (const Explanation& e : explanations) {
    const double weight = std::exp(e.log_weight - most) / sum;
    found.mean(e.numbers) += weight * e.mean;
    moments(e.numbers, e.numbers) += weight * (e.covariance + e.mean * e.mean.transpose());
  }
  moments -= found.mean * found.mean.transpose();
  return found;
}

}  // namespace vinebench::slam
