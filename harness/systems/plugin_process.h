// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "harness/systems/host/plugin_link.h"
#include "harness/systems/slam_choice.h"

namespace vinebench::harness {

/// The program of a plug-in's process, vinebench_plugin_host: beside `program` (as built) or in
/// `../libexec/vinebench` of its folder (as installed); empty if it is in neither.
std::filesystem::path find_plugin_host(const std::filesystem::path& program);

/// Starts a process of the program `host` that loads the plug-in. Images are given to it in shared
/// memory. The process ends with the link, and with this process. Throws Error if it cannot be
/// started and as LoadedPlugin() does, SystemFailure if the plug-in ends it, or exceeds a limit of
/// the configuration; the link's functions throw SystemFailure likewise. Once `stopped` (may be
/// empty) returns true, a call has a second left.
std::unique_ptr<PluginLink> start_plugin_process(const std::filesystem::path& host,
                                                 const PluginSlamConfig& config,
                                                 const vinebench_setup& setup,
                                                 std::function<bool()> stopped);

}  // namespace vinebench::harness
