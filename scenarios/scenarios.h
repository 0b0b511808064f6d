// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The experiments and the judge: reads a scenario, runs a SLAM system on its simulation in
/// lockstep, compares what it says with the truth, and writes down what happened. Only here do
/// simulation and SLAM meet.

#include "scenarios/evaluation.h"
#include "scenarios/lockstep.h"
#include "scenarios/replay.h"
#include "scenarios/run_folder.h"
#include "scenarios/run_scenario.h"
#include "scenarios/scenario.h"
