// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace vinebench::harness {

/// Runs the job in a process of its own, forked from this one, and returns its text: for figures
/// that belong to a process, such as its peak memory, and for libraries that read their environment
/// only once. To be called while this process has one thread and no GL context. An Error of the
/// job's is thrown here; other failures too, as Errors that name `what`.
std::string run_in_child(const std::string& what, const std::function<std::string()>& job);

/// What became of a job in a process of its own.
struct ChildOutcome {
  bool ok = false;
  std::string text;  ///< the job's; else why there is none
};

/// Jobs for processes of their own, some of them side by side.
struct ChildJobs {
  std::size_t count = 0;
  int at_once = 1;
  std::function<std::string(std::size_t)> name{};                ///< for messages
  std::function<std::string(std::size_t)> job{};                 ///< called in the child
  std::function<void(std::size_t, const ChildOutcome&)> done{};  ///< called here, one at a time
  std::function<bool()> stopped{};                               ///< may be empty
};

/// Runs them all, on the conditions of run_in_child. A job that fails does not end the others. Once
/// `stopped` says so no further job is started, and those that run are sent SIGTERM, once; they are
/// in groups of their own, so that ^C reaches them by this way alone, and they end with this
/// process.
void run_in_children(const ChildJobs& jobs);

}  // namespace vinebench::harness
