// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "harness/systems/group_watcher.h"
#include "harness/systems/spawn.h"

namespace vinebench::harness {

/// Throws Error if the file is neither a program nor a script whose interpreter is one, or may not
/// be executed.
void check_executable(const std::filesystem::path& file);

/// A started process in a group of its own, with the processes that it starts. Destruction kills
/// them, and so does the end of this process, whatever ends it (GroupWatcher).
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
  GroupWatcher watcher_;  // first member: the process joins its group
  pid_t process_ = 0;
  bool ended_ = false;
  int status_ = 0;
  std::chrono::steady_clock::time_point looked_{};
};

}  // namespace vinebench::harness
