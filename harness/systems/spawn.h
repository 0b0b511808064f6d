// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

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
  int input = -1;                  ///< becomes its standard input; nothing to read if negative
  bool blocks_signals = false;     ///< all that can be blocked
};

/// Starts a process in a process group, with no signal ignored; group 0 is a new one,
/// with the process' own number. Returns the process' number. Throws Error if it cannot be started.
pid_t spawn_process(const ProcessStart& start, pid_t group);

}  // namespace vinebench::harness
