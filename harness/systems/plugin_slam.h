// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "harness/systems/slam_choice.h"
#include "slam/odometry/wheel_odometry.h"

namespace vinebench::harness {

/// What a plug-in needs beside its configuration.
struct PluginSurroundings {
  std::filesystem::path host;     ///< find_plugin_host(); unused with PluginSlamConfig::in_process
  std::function<bool()> stopped;  ///< polled while the plug-in works; may be empty
};

/// Creates the SLAM system of a shared object (core/slam_plugin.h), in a process of its own unless
/// the configuration says otherwise. Throws Error if it cannot be loaded, has another version of
/// the interface, or reports that it cannot be created. Its process() and finish() throw
/// SystemFailure for whatever goes wrong in the plug-in; so does the first process() if it failed
/// while it was created.
std::unique_ptr<SlamSystem> load_plugin_slam(const PluginSlamConfig& config, const Rig& rig,
                                             const std::vector<RegisteredTag>& tags,
                                             const std::optional<slam::MecanumWheels>& wheels,
                                             int threads, const PluginSurroundings& around);

}  // namespace vinebench::harness
