// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace vinebench::harness {

/// An external program.
struct Program {
  std::filesystem::path file;
  std::vector<std::string> arguments;
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to this process' own
  std::filesystem::path folder;                                  ///< where it runs
  std::filesystem::path log;                                     ///< for its output
  double timeout = 3600;                                         ///< s
  double memory_mib = std::numeric_limits<double>::infinity();   ///< of all its processes
  std::function<bool()> stopped;  ///< polled while it runs; may be empty
};

/// Runs it to its end in a separate process group, which is killed when the program ends, at a
/// limit and when `stopped` returns true; returns false if it was stopped. Throws Error if it
/// cannot be started, ends with an exit code other than 0 or exceeds a limit; the message has its
/// last line of output.
bool run_program(const Program& program);

}  // namespace vinebench::harness
