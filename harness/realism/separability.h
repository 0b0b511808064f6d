// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "harness/realism/picture_set.h"

namespace vinebench::harness {

/// Area under the ROC curve (Mann and Whitney's statistic): the probability that a positive's score
/// is above a negative's; ties count half.
double area_under_roc(const std::vector<double>& positives, const std::vector<double>& negatives);

/// Weights of a ridge-regularised logistic regression, by Newton's method: `rows` has a sample a
/// row, `positive` is 0 or 1 for each, both classes count alike. The last weight is the constant's,
/// which is not regularised.
Eigen::VectorXd fit_logistic(const Eigen::MatrixXd& rows, const Eigen::VectorXd& positive,
                             double ridge);

/// How well a logistic regression on the statistics (standardised; those that all pictures have)
/// tells the sets apart, in five-fold cross-validation; pictures of one group are in one fold. None
/// if either set has fewer than five groups.
std::optional<double> separability(const PictureSet& real, const PictureSet& ours);

}  // namespace vinebench::harness
