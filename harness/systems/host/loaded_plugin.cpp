// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/host/loaded_plugin.h"

#include <cxxabi.h>
#include <dlfcn.h>

#include <algorithm>
#include <exception>

#include "harness/run/system_failure.h"

namespace vinebench::harness {
namespace {

vinebench_slam_functions load_functions(const std::string& file) {
  void* object = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) fail("slam.plugin.library: {}", dlerror());
  using Entry = const vinebench_slam_functions* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(object, "vinebench_slam"));
  if (entry == nullptr) {
    fail("slam.plugin.library: {}: exports no vinebench_slam (core/slam_plugin.h)", file);
  }
  const vinebench_slam_functions* functions = entry();
  const std::uint32_t version = functions == nullptr ? 0 : functions->version;
  if (version < VINEBENCH_SLAM_PLUGIN_OLDEST_VERSION || version > VINEBENCH_SLAM_PLUGIN_VERSION) {
    fail("slam.plugin.library: {}: expected version {} to {} of core/slam_plugin.h, found {}", file,
         VINEBENCH_SLAM_PLUGIN_OLDEST_VERSION, VINEBENCH_SLAM_PLUGIN_VERSION, version);
  }
  return *functions;
}

/// Calls a function of the plug-in; its exceptions become SystemFailures that name it.
template <class Function>
auto guarded(const std::string& file, const char* name, const Function& function) {
  try {
    return function();
  } catch (const std::exception& error) {
    fail_system("{}: {}: threw an exception: {}", file, name, error.what());
  } catch (const abi::__forced_unwind&) {
    throw;  // the end of a thread
  } catch (...) {
    fail_system("{}: {}: threw what is no std::exception", file, name);
  }
}

std::vector<vinebench_stamped_pose> copy_of(const vinebench_stamped_pose* poses,
                                            std::size_t count) {
  return count == 0 ? std::vector<vinebench_stamped_pose>()
                    : std::vector<vinebench_stamped_pose>(poses, poses + count);
}

}  // namespace

LoadedPlugin::LoadedPlugin(const std::string& file, const vinebench_setup& setup)
    : file_(file),
      cameras_(setup.camera_count),
      functions_(load_functions(file)),
      name_(functions_.name == nullptr ? "plugin" : functions_.name) {
  system_ = guarded(file_, "create", [&] { return functions_.create(&setup, message()); });
  if (system_ == nullptr) fail("{}: create: {}", file_, said());
}

LoadedPlugin::~LoadedPlugin() {
  functions_.destroy(system_);
}

PluginEstimate LoadedPlugin::process(const vinebench_frame& frame) {
  PluginEstimate answer;
  answer.counts.resize(cameras_);
  answer.estimate.counts = answer.counts.data();
  const int code = guarded(file_, "process", [&] {
    return functions_.process(system_, &frame, &answer.estimate, message());
  });
  if (code != 0) fail_system("{}: process: {}", file_, said());
  return answer;
}

PluginSummary LoadedPlugin::finish() {
  vinebench_summary answer{};
  const int code =
      guarded(file_, "finish", [&] { return functions_.finish(system_, &answer, message()); });
  if (code != 0) fail_system("{}: finish: {}", file_, said());
  return {copy_of(answer.trajectory, answer.trajectory_count),
          copy_of(answer.keyframes, answer.keyframe_count), answer.landmarks};
}

vinebench_message LoadedPlugin::message() {
  message_.fill('\0');
  return {message_.data(), message_.size()};
}

std::string LoadedPlugin::said() const {
  const std::string text(message_.begin(), std::ranges::find(message_, '\0'));
  return text.empty() ? "failed without a message" : text;
}

}  // namespace vinebench::harness
