// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "harness/jobs/run_scenario.h"
#include "python/frames.h"

namespace vinebench::python {

/// A SLAM system written in Python: an adapter of vinebench/_adapter.py, which checks and converts
/// what the user's object answers. An exception of it is a SystemFailure; KeyboardInterrupt and
/// SystemExit go on as they are. Called without the GIL.
std::unique_ptr<SlamSystem> make_python_system(const py::object& adapter,
                                               const harness::SystemSetup& setup);

py::dict dict_of(const Rig& rig, const Estimate& estimate);
py::dict dict_of(const SlamSummary& summary);

/// vinebench._core.Slam, the built-in core.
void define_slam(py::module_& module);

/// vinebench._core.RosMessages, for vinebench/ros2.py.
void define_ros_messages(py::module_& module);

/// `run`, and the evaluation of trajectories.
void define_runs(py::module_& module);
void define_evaluation(py::module_& module);

}  // namespace vinebench::python
