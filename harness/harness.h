// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Runs and evaluates experiments: reads a scenario, runs a SLAM system on its simulation in
/// lockstep, compares the estimate with the ground truth and writes the results. The only folder
/// that uses both simulation and SLAM.

#include "harness/experiment/scenario.h"
#include "harness/jobs/run_scenario.h"
#include "harness/judge/evaluation.h"
#include "harness/replay.h"
#include "harness/report/run_folder.h"
#include "harness/run/lockstep.h"
