// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The experiments and the judge: reads a scenario, runs a SLAM system on its simulation in
/// lockstep, compares what it says with the truth, and writes down what happened. Only here do
/// simulation and SLAM meet.

#include "harness/experiment/scenario.h"
#include "harness/jobs/run_scenario.h"
#include "harness/judge/evaluation.h"
#include "harness/replay.h"
#include "harness/report/run_folder.h"
#include "harness/run/lockstep.h"
