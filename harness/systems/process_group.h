// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace vinebench::harness {

/// What a process is started with.
struct ProcessStart {
  std::filesystem::path file;
  std::vector<std::string> arguments;
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added to this process' own
  std::filesystem::path folder{};  ///< where it runs; this process' own if empty
  std::filesystem::path log{};     ///< for its output; standard error if empty
  std::vector<int> descriptors{};  ///< become its 3, 4, ...; all others are closed
};

/// Throws Error if the file is neither a program nor a script whose interpreter is one, or may not
/// be executed.
void check_executable(const std::filesystem::path& file);

/// A started process in a group of its own, with the processes that it starts. Destruction kills
/// them.
class ProcessGroup {
 public:
  /// Throws Error if it cannot be started.
  explicit ProcessGroup(const ProcessStart& start);
  ~ProcessGroup() { kill(); }
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  /// Whether the started process has ended, which ends the others too; never waits.
  bool has_ended();
  /// Waits at most that long.
  bool wait(std::chrono::milliseconds longest);
  /// Of a process that has ended: "exit code 3", "ended by signal 11 (Segmentation fault)".
  std::string how_it_ended() const;
  bool succeeded() const;  ///< with exit code 0

  /// Whether the resident memory of the group's processes exceeds this, MiB. Looks at most ten
  /// times a second, and answers false in between.
  bool exceeds_memory(double limit_mib);

  void kill();

 private:
  pid_t process_ = 0;
  bool ended_ = false;
  int status_ = 0;
  std::chrono::steady_clock::time_point looked_{};
};

}  // namespace vinebench::harness
