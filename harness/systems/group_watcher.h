// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include "core/files/descriptor.h"

namespace vinebench::harness {

/// A small process that begins a process group and kills it, with itself, when this process ends
/// without having done so, whatever ends this process (SIGKILL too). A process that leaves the
/// group (setsid, setpgid) is not found. Unlike Linux' signal at the parent's death this also holds
/// for what the group's processes start, and not only while the thread lives that started them.
class GroupWatcher {
 public:
  /// Throws Error if it cannot be started.
  GroupWatcher();
  ~GroupWatcher() { kill_group(); }
  GroupWatcher(const GroupWatcher&) = delete;
  GroupWatcher& operator=(const GroupWatcher&) = delete;

  /// The group's number, which is no other group's until kill_group().
  pid_t group() const { return process_; }
  /// Kills all processes of the group, the watcher too; once.
  void kill_group();

 private:
  Descriptor alive_;  ///< a pipe's end for writing, in this process alone
  pid_t process_ = 0;
};

}  // namespace vinebench::harness
