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
constexpr std::size_t kMostPairsApart = 2;

/// Sets of causes that are less likely change nothing.
constexpr double kLeastWeight = 1e-9;

/// Numbers that differ from the rig file together.
using Cause = std::vector<Eigen::Index>;

/// What may be wrong with a rig of so many pairs: a pair's mounting, its lenses, its clock and so
/// on, and the clocks of the cameras for tags, whose times are the other numbers. Of baselines a
/// drive shows by how much the pairs differ from each other, seldom which of them it is: they are
/// wrong for all pairs or for none.
std::vector<Cause> possible_causes(std::size_t pairs, Eigen::Index unknowns) {
  const Eigen::Index of_pairs = kPairUnknowns * static_cast<Eigen::Index>(pairs);
  const auto of_all_pairs = [of_pairs](Eigen::Index first, Eigen::Index count) {
    Cause cause;
    for (Eigen::Index pair = 0; pair < of_pairs; pair += kPairUnknowns) {
      for (Eigen::Index i = first; i < first + count; ++i) cause.push_back(pair + i);
    }
    return cause;
  };
  std::vector<Cause> causes{of_all_pairs(PairNumber::kBaseline, 1)};
  struct Range {
    Eigen::Index first, count;
  };
  for (const auto& [first, count] :
       {Range{PairNumber::kTime, 1}, Range{PairNumber::kPlace, 6},
        Range{PairNumber::kDisparityOffset, 1}, Range{PairNumber::kDisparitySlope, 1},
        Range{PairNumber::kFocal, 1}, Range{PairNumber::kReadout, 1},
        Range{PairNumber::kPrincipalPoint, 6}}) {
    if (pairs > kMostPairsApart) {
      causes.push_back(of_all_pairs(first, count));
      continue;
    }
    for (Eigen::Index pair = 0; pair < of_pairs; pair += kPairUnknowns) {
      Cause& cause = causes.emplace_back();
      for (Eigen::Index i = 0; i < count; ++i) cause.push_back(pair + first + i);
    }
  }
  if (unknowns > of_pairs) {
    Cause& times = causes.emplace_back();
    for (Eigen::Index i = of_pairs; i < unknowns; ++i) times.push_back(i);
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

/// What a belief says of some numbers while the others are as the rig file has them. Numbers are
/// added and taken off at the end, each for the price of a row of a Cholesky factor.
class Subset {
 public:
  explicit Subset(const CalibrationBelief& belief)
      : belief_(belief),
        factor_(Eigen::MatrixXd::Zero(belief.information.rows(), belief.information.cols())),
        row_(belief.information.rows()),
        solved_(Eigen::VectorXd::Zero(belief.information.rows())) {}

  void add(Eigen::Index number) {
    const auto n = static_cast<Eigen::Index>(numbers_.size());
    auto row = row_.head(n);
    row = belief_.information(numbers_, number);
    if (!row.isZero(0)) {
      factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(row);
    }
    const double pivot = std::sqrt(belief_.information(number, number) - row.squaredNorm());
    factor_.row(n).head(n) = row.transpose();
    factor_(n, n) = pivot;
    solved_[n] = (belief_.information_vector[number] - row.dot(solved_.head(n))) / pivot;
    numbers_.push_back(number);
    logarithms_.push_back(logarithm() + std::log(pivot));
  }
  void remove(std::size_t count) {
    numbers_.resize(numbers_.size() - count);
    logarithms_.resize(numbers_.size());
  }

  /// Logarithm of the integral of the belief over these numbers, but for powers of 2 pi.
  double log_integral() const {
    const auto n = static_cast<Eigen::Index>(numbers_.size());
    return 0.5 * solved_.head(n).squaredNorm() - logarithm();
  }

 private:
  /// Of the product of the factor's diagonal.
  double logarithm() const { return logarithms_.empty() ? 0 : logarithms_.back(); }

  const CalibrationBelief& belief_;
  std::vector<Eigen::Index> numbers_;
  std::vector<double> logarithms_;  ///< logarithm() with each number
  Eigen::MatrixXd factor_;
  Eigen::VectorXd row_;  ///< to work on
  Eigen::VectorXd solved_;
};

/// Logarithms of the evidence of all sets of causes, against the rig file as it is.
class Evidence {
 public:
  Evidence(const CalibrationBelief& now, const CalibrationBelief& prior,
           const std::vector<Cause>& causes)
      : causes_(causes), now_(now), prior_(prior), logarithms_(std::size_t{1} << causes.size()) {
    visit(0, 0);
  }
  const std::vector<double>& logarithms() const { return logarithms_; }

 private:
  /// All sets of the causes from `next` on beside those of `set`.
  void visit(std::size_t set, std::size_t next) {
    logarithms_[set] = now_.log_integral() - prior_.log_integral();
    for (std::size_t c = next; c < causes_.size(); ++c) {
      for (const Eigen::Index number : causes_[c]) {
        now_.add(number);
        prior_.add(number);
      }
      visit(set | std::size_t{1} << c, c + 1);
      now_.remove(causes_[c].size());
      prior_.remove(causes_[c].size());
    }
  }

  const std::vector<Cause>& causes_;
  Subset now_;
  Subset prior_;
  std::vector<double> logarithms_;
};

}  // namespace

CalibrationAverage average(const CalibrationBelief& now, const CalibrationBelief& prior,
                           std::size_t pairs) {
  const Eigen::Index size = now.information_vector.size();
  const std::vector<Cause> causes = possible_causes(pairs, size);
  std::vector<double> logarithms = Evidence(now, prior, causes).logarithms();
  const std::size_t sets = logarithms.size();
  for (std::size_t set = 1; set < sets; ++set) {
    logarithms[set] -= std::log(static_cast<double>(sets - 1));
  }
  const double most = *std::ranges::max_element(logarithms);
  double sum = 0;
  for (const double logarithm : logarithms) sum += std::exp(logarithm - most);

  CalibrationAverage found{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size),
                           std::exp(logarithms[0] - most) / sum, 0};
  Eigen::MatrixXd& moments = found.covariance;  // about the rig file, at first
  // As before anything is seen, where each of the sets counts.
  const bool apart = now.information.isDiagonal(0) && now.information_vector.isZero(0);
  for (std::size_t set = 1; set < sets; ++set) {
    const double weight = std::exp(logarithms[set] - most) / sum;
    if (weight < kLeastWeight) continue;
    const std::vector<Eigen::Index> numbers = numbers_of(causes, set);
    found.numbers_at_work += weight * static_cast<double>(numbers.size());
    if (apart) {
      for (const Eigen::Index i : numbers) moments(i, i) += weight * (1 / now.information(i, i));
      continue;
    }
    const Eigen::LDLT<Eigen::MatrixXd> information(now.information(numbers, numbers));
    const Eigen::VectorXd mean = information.solve(now.information_vector(numbers));
    const auto count = static_cast<Eigen::Index>(numbers.size());
    found.mean(numbers) += weight * mean;
    moments(numbers, numbers) +=
        weight *
        (information.solve(Eigen::MatrixXd::Identity(count, count)) + mean * mean.transpose());
  }
  moments -= found.mean * found.mean.transpose();
  return found;
}

}  // namespace vinebench::slam
