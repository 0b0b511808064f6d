// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vinebench::harness {

/// Somebody else's program.
struct Program {
  std::filesystem::path file;
  std::vector<std::string> arguments;
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to this process' own
  std::filesystem::path folder;                                  ///< where it runs
  std::filesystem::path log;                                     ///< takes what it prints
  double timeout = 3600;                                         ///< s
  std::function<bool()> stopped;  ///< asked while it runs; may be empty
};

/// Runs it to its end, in a process group of its own, which is killed at the timeout and when
/// `stopped` says so; then it returns false. Throws Error when it cannot be started, ends otherwise
/// than with exit code 0 or takes too long; the message has the last line that it printed.
bool run_program(const Program& program);

}  // namespace vinebench::harness
