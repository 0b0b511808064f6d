// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/config.h"

namespace vinebench::harness {

/// A SLAM system that is a program: it gets a recording of the run and writes a trajectory.
struct ExternalSlamConfig {
  std::filesystem::path program;  ///< executable, relative to the file
  /// "{recording}" and "{output}" in them stand for the folders.
  std::vector<std::string> arguments{"{recording}", "{output}"};
  std::string trajectory = "trajectory.txt";  ///< file that it writes, in its output folder
  std::string poses_of = "body";              ///< frame of its poses: "body", or a camera
  double timeout = 3600;                      ///< s, of wall time
  double memory_mib = 8192;                   ///< resident memory of all its processes, MiB
  bool keep_recording = false;                ///< do not remove the recording after the run
  template <class Archive>
  void serialize(Archive& archive) {
    archive("program", program);
    archive("arguments", arguments);
    archive("trajectory", trajectory);
    archive("poses_of", poses_of);
    archive("timeout", timeout, Range::positive());
    archive("memory_mib", memory_mib, Range::positive());
    archive("keep_recording", keep_recording);
    archive.require(!program.empty(), "program", "expected an executable file");
    archive.require(is_below(trajectory), "trajectory",
                    "expected a file in the program's output folder: a relative path without '..'");
  }

 private:
  static bool is_below(const std::filesystem::path& file) {
    if (!file.has_filename() || file.is_absolute()) return false;
    for (const std::filesystem::path& part : file) {
      if (part == "..") return false;
    }
    return file.filename() != ".";
  }
};

/// A SLAM system in a shared object, as of core/slam_plugin.h.
struct PluginSlamConfig {
  std::filesystem::path library;                    ///< shared object, relative to the file
  std::optional<std::filesystem::path> settings{};  ///< passed on to it
  bool in_process = false;    ///< in the bench's process, without limits, instead of its own
  double frame_timeout = 60;  ///< s, of wall time, for each frame
  double timeout = 600;       ///< s, likewise, to create it, and for the final result
  double memory_mib = 8192;   ///< resident memory of its process, MiB
  template <class Archive>
  void serialize(Archive& archive) {
    archive("library", library);
    archive("settings", settings);
    archive("in_process", in_process);
    archive("frame_timeout", frame_timeout, Range::positive());
    archive("timeout", timeout, Range::positive());
    archive("memory_mib", memory_mib, Range::positive());
    archive.require(!library.empty(), "library", "expected a shared object");
  }
};

/// A scenario's `slam`: settings of the core, or another system instead.
struct SlamChoice : slam::SlamConfig {
  std::optional<ExternalSlamConfig> external{};
  std::optional<PluginSlamConfig> plugin{};

  bool is_core() const { return !external && !plugin; }

  template <class Archive>
  void serialize(Archive& archive) {
    slam::SlamConfig::serialize(archive);
    archive("external", external);
    archive("plugin", plugin);
    archive.require(!external || !plugin, "plugin", "expected one of external and plugin");
  }
};

}  // namespace vinebench::harness
