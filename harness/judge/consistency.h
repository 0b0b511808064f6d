// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// The mean NEES of covariances that say how large the errors are: a pose's degrees of freedom.
inline constexpr double kConsistentNees = 6;

/// Consistency of the covariances: the normalised estimation error squared (NEES, Bar-Shalom, Li
/// and Kirubarajan 2001, Sect. 5.4) of the live poses, six degrees of freedom. 6 on average if the
/// covariances are consistent, less if they are too large.
struct Consistency {
  int frames = 0;          ///< with a pose and an invertible covariance
  double nees_mean = 0;    ///< of these; 0 if there are none
  double within_95 = 0;    ///< share of them below 12.59, the 95 % quantile of chi-square, 0 to 1
  int not_invertible = 0;  ///< frames with a pose that are left out because of their covariance
};

/// Of all frames with a pose and a covariance. The map's frame is the world's where the first pose
/// is by a registered tag. Where none is registered, it is the first pose's, and errors count from
/// there. Where one is, but not in view at first, or rejected, they count from a first pose that
/// the system calls exact, until a loop is closed: nothing says where the map's frame lies then.
/// Empty where the first pose is neither, and for a system that gives no covariance at all.
std::optional<Consistency> check_consistency(const RunRecord& record);

/// Readable line on the frames that are left out because of their covariance; empty without any.
std::string format_left_out(const std::optional<Consistency>& consistency);

}  // namespace vinebench::harness
