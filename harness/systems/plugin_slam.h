// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "harness/systems/slam_choice.h"
#include "slam/odometry/wheel_odometry.h"

namespace vinebench::harness {

/// Creates the SLAM system of a shared object (core/slam_plugin.h). Throws Error if it cannot be
/// loaded, has another version of the interface, or reports a failure; process and finish do too.
std::unique_ptr<SlamSystem> load_plugin_slam(const PluginSlamConfig& config, const Rig& rig,
                                             const std::vector<RegisteredTag>& tags,
                                             const std::optional<slam::MecanumWheels>& wheels,
                                             int threads);

}  // namespace vinebench::harness
