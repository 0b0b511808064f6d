// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <atomic>

#include "slam/solver/terms.h"

namespace vinebench::slam {

struct SchurOptions {
  int iterations = 25;
  double tolerance = 1e-4;         ///< relative decrease of the cost at which it is done
  int linear_steps = 100;          ///< of conjugate gradients in an iteration, at most
  double linear_tolerance = 1e-2;  ///< of the error that they leave, in the matrix's norm
};

/// Moves the blocks of a problem to where its cost has a minimum, by steps of Gauss and Newton with
/// the damping of Levenberg and Marquardt and weights for the losses. Made for the poses of a long
/// drive: each point is eliminated where it is linearised (Schur complement), and what is left of
/// the poses is solved by conjugate gradients with TwoLevel, which takes runs of them as one body.
/// What it does depends on nothing but the problem. Returns the cost reached. Ends after the
/// iteration at which `stop` is set.
double solve_by_schur(ceres::Problem& problem, const Unknowns& unknowns,
                      const SchurOptions& options, const std::atomic<bool>& stop);

}  // namespace vinebench::slam
