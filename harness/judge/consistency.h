// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// Consistency of the covariances: the normalised estimation error squared (NEES, Bar-Shalom, Li
/// and Kirubarajan 2001, Sect. 5.4) of the live poses, six degrees of freedom. 6 on average if the
/// covariances are consistent, less if they are too large.
struct Consistency {
  double nees_mean = 0;
  double within_95 =
      0;  ///< share of the frames below 12.59, the 95 % quantile of chi-square, 0 to 1
};

/// Of all frames with a pose and a covariance. Empty unless a registered tag was in view at the
/// first pose: only then the map frame is aligned with the world.
std::optional<Consistency> check_consistency(const RunRecord& record);

}  // namespace vinebench::harness
