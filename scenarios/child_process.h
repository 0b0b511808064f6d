// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace vinebench {

/// Runs the job in a process of its own, forked from this one, and returns its text: for figures
/// that belong to a process, such as its peak memory, and for libraries that read their environment
/// only once. To be called while this process has one thread and no GL context. An Error of the
/// job's is thrown here; other failures too, as Errors that name `what`.
std::string run_in_child(const std::string& what, const std::function<std::string()>& job);

}  // namespace vinebench
