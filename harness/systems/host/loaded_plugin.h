// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "harness/systems/host/plugin_link.h"

namespace vinebench::harness {

/// A system of a shared object that is loaded into this process. Exceptions that leave the plug-in
/// are SystemFailures.
class LoadedPlugin : public PluginLink {
 public:
  /// Keeps a copy of nothing in the setup, which must outlive it. Throws Error if the file cannot
  /// be loaded, has another version of the interface, or reports that it cannot create a system.
  LoadedPlugin(const std::string& file, const vinebench_setup& setup);
  /// The shared object stays loaded: its libraries may have threads and exit handlers.
  ~LoadedPlugin() override;
  LoadedPlugin(const LoadedPlugin&) = delete;
  LoadedPlugin& operator=(const LoadedPlugin&) = delete;

  const std::string& name() const override { return name_; }
  PluginEstimate process(const vinebench_frame& frame) override;
  PluginSummary finish() override;

 private:
  vinebench_message message();
  std::string said() const;

  std::string file_;
  std::size_t cameras_;
  vinebench_slam_functions functions_;
  std::string name_;
  std::array<char, 1024> message_{};
  void* system_ = nullptr;
};

}  // namespace vinebench::harness
