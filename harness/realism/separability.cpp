// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/separability.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

namespace vinebench::harness {
namespace {

constexpr int kFolds = 5;
constexpr double kRidge = 1;  // of standardised statistics
constexpr int kSteps = 30;
constexpr double kConverged = 1e-9;

/// All pictures of both sets, with their folds.
struct Samples {
  Eigen::MatrixXd rows;
  Eigen::VectorXd positive;  ///< 1: ours
  std::vector<int> fold;
};

/// Groups in the order of their names go to the folds in turn.
std::map<std::string, int> folds_of(const PictureSet& set) {
  std::map<std::string, int> folds;
  for (const MeasuredPicture& picture : set.pictures) folds[picture.group] = 0;
  int next = 0;
  for (auto& [group, fold] : folds) fold = next++ % kFolds;
  return folds;
}

/// The statistics that every picture of both sets has.
std::vector<std::string> common_statistics(const PictureSet& real, const PictureSet& ours) {
  std::vector<std::string> names;
  for (const std::string& name : real.statistics()) {
    if (real.values(name).size() == real.pictures.size() &&
        ours.values(name).size() == ours.pictures.size()) {
      names.push_back(name);
    }
  }
  return names;
}

Samples samples_of(const PictureSet& real, const PictureSet& ours) {
  const std::vector<std::string> names = common_statistics(real, ours);
  const auto rows = static_cast<Eigen::Index>(real.pictures.size() + ours.pictures.size());
  Samples samples{
      Eigen::MatrixXd(rows, static_cast<Eigen::Index>(names.size())), Eigen::VectorXd(rows), {}};
  for (std::size_t column = 0; column < names.size(); ++column) {
    Eigen::Index row = 0;
    for (const PictureSet* set : {&real, &ours}) {
      for (const double value : set->values(names[column])) {
        samples.rows(row++, static_cast<Eigen::Index>(column)) = value;
      }
    }
  }
  Eigen::Index row = 0;
  for (const PictureSet* set : {&real, &ours}) {
    std::map<std::string, int> folds = folds_of(*set);
    for (const MeasuredPicture& picture : set->pictures) {
      samples.positive[row++] = set == &ours ? 1 : 0;
      samples.fold.push_back(folds.at(picture.group));
    }
  }
  return samples;
}

/// The rows inside or outside of a fold.
std::vector<Eigen::Index> rows_of(const Samples& samples, int fold, bool inside) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < samples.fold.size(); ++i) {
    if ((samples.fold[i] == fold) == inside) rows.push_back(static_cast<Eigen::Index>(i));
  }
  return rows;
}

Eigen::MatrixXd standardised(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& reference) {
  const Eigen::RowVectorXd mean = reference.colwise().mean();
  const Eigen::MatrixXd centred = reference.rowwise() - mean;
  const Eigen::RowVectorXd deviation =
      (centred.colwise().squaredNorm() / static_cast<double>(reference.rows())).cwiseSqrt();
  return ((rows.rowwise() - mean).array().rowwise() / deviation.cwiseMax(1e-12).array()).matrix();
}

Eigen::VectorXd scores(const Eigen::MatrixXd& rows, const Eigen::VectorXd& weights) {
  const Eigen::Index columns = rows.cols();
  return (rows * weights.head(columns)).array() + weights[columns];
}

}  // namespace

double area_under_roc(const std::vector<double>& positives, const std::vector<double>& negatives) {
  double sum = 0;
  for (const double positive : positives) {
    for (const double negative : negatives) {
      sum += positive > negative ? 1 : positive == negative ? 0.5 : 0;
    }
  }
  return sum / static_cast<double>(positives.size() * negatives.size());
}

Eigen::VectorXd fit_logistic(const Eigen::MatrixXd& rows, const Eigen::VectorXd& positive,
                             double ridge) {
  Eigen::MatrixXd x(rows.rows(), rows.cols() + 1);
  x << rows, Eigen::VectorXd::Ones(rows.rows());
  const double positives = positive.sum();
  const double negatives = static_cast<double>(positive.size()) - positives;
  const Eigen::VectorXd importance =
      (positive.array() * (0.5 / positives) + (1 - positive.array()) * (0.5 / negatives)) *
      static_cast<double>(positive.size());
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(x.cols(), ridge);
  penalty[x.cols() - 1] = 0;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(x.cols());
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::ArrayXd p = 1 / (1 + (-(x * weights).array()).exp());
    const Eigen::VectorXd gradient =
        x.transpose() * (importance.array() * (p - positive.array())).matrix() +
        penalty.cwiseProduct(weights);
    const Eigen::VectorXd curvature = (importance.array() * p * (1 - p)).matrix();
    Eigen::MatrixXd hessian = x.transpose() * curvature.asDiagonal() * x;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd change = hessian.ldlt().solve(gradient);
    weights -= change;
    if (change.norm() < kConverged) break;
  }
  return weights;
}

std::optional<double> separability(const PictureSet& real, const PictureSet& ours) {
  for (const PictureSet* set : {&real, &ours}) {
    if (folds_of(*set).size() < kFolds) return std::nullopt;
  }
  const Samples samples = samples_of(real, ours);
  std::vector<double> of_ours;
  std::vector<double> of_real;
  for (int fold = 0; fold < kFolds; ++fold) {
    const std::vector<Eigen::Index> fitted = rows_of(samples, fold, false);
    const std::vector<Eigen::Index> tested = rows_of(samples, fold, true);
    const Eigen::MatrixXd reference = samples.rows(fitted, Eigen::all);
    const Eigen::VectorXd weights =
        fit_logistic(standardised(reference, reference), samples.positive(fitted), kRidge);
    const Eigen::VectorXd found =
        scores(standardised(samples.rows(tested, Eigen::all), reference), weights);
    for (std::size_t i = 0; i < tested.size(); ++i) {
      (samples.positive[tested[i]] > 0 ? of_ours : of_real)
          .push_back(found[static_cast<Eigen::Index>(i)]);
    }
  }
  return area_under_roc(of_ours, of_real);
}

}  // namespace vinebench::harness
