// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace vinebench::harness {

/// Runs the job in a forked process and returns its text: for measurements of a process, such as
/// its peak memory, and for libraries that read their environment only once. It is killed if this
/// process ends, even by SIGKILL. Requires that this process has one thread and no GL context. An
/// Error of the job is rethrown here; other failures are thrown as Errors that name `what`.
std::string run_in_child(const std::string& what, const std::function<std::string()>& job);

/// The outcome of a job in a child process.
struct ChildOutcome {
  bool ok = false;
  std::string text;  ///< the job's text, or the reason of its failure
};

/// Jobs for child processes, some of them in parallel.
struct ChildJobs {
  std::size_t count = 0;
  int at_once = 1;
  std::function<std::string(std::size_t)> name{};  ///< for messages
  std::function<std::string(std::size_t)> job{};   ///< called in the child
  std::function<void(std::size_t, const ChildOutcome&)>
      done{};                       ///< called in this process, one at a time
  std::function<bool()> stopped{};  ///< may be empty
};

/// Runs all jobs, with the requirements of run_in_child. A failing job does not end the others.
/// Once `stopped` returns true no further job is started, and running ones are sent SIGTERM once.
/// They are in separate process groups, so that ^C reaches them in this manner only.
void run_in_children(const ChildJobs& jobs);

}  // namespace vinebench::harness
