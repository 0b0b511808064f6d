// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// Whether an estimator is as sure as it may be: the normalised estimation error squared (NEES,
/// Bar-Shalom, Li and Kirubarajan 2001, Sect. 5.4) of the poses as they were known at their own
/// frame, six degrees of freedom. 6 on average where the covariances are right, less where they are
/// too large.
struct Consistency {
  double nees_mean = 0;
  double within_95 = 0;  ///< share of the frames below 12.59, the 95 % of chi-square, 0 to 1
};

/// Of all frames with a pose and a covariance. Nothing unless the first pose came with a registered
/// tag in view: only then is the estimator's map where the world is.
std::optional<Consistency> check_consistency(const RunRecord& record);

}  // namespace vinebench::harness
