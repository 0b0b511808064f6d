// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/group_watcher.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/util/error.h"
#include "harness/systems/spawn.h"

namespace vinebench::harness {
namespace {

/// Nothing is ever written: the pipe ends with the process that holds its other end. The shell's
/// own group is 0.
constexpr const char* kWatch = "read -r line; kill -KILL 0";

}  // namespace

GroupWatcher::GroupWatcher() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("a pipe: {}", std::strerror(errno));
  const Descriptor input(ends[0]);
  alive_ = Descriptor(ends[1]);
  process_ = spawn_process({.file = "/bin/sh",
                            .arguments = {"-c", kWatch},
                            .input = input.number(),
                            .blocks_signals = true},
                           0);
}

void GroupWatcher::kill_group() {
  if (process_ == 0) return;
  ::kill(-process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
}

}  // namespace vinebench::harness
