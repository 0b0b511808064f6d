// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What runs a SLAM system in lockstep on frames from anywhere, compares what it says with the
/// truth, and writes down what happened. Scenarios, which need the simulation, are in experiment/
/// and jobs/.

#include "harness/judge/evaluation.h"
#include "harness/replay.h"
#include "harness/report/run_folder.h"
#include "harness/run/lockstep.h"
