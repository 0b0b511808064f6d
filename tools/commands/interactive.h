// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "harness/run.h"

namespace vinebench::tools {

// What commands that run a SLAM system while a person watches have in common.

/// The first ^C ends the run after its frame; a second one ends the program at once.
void catch_interrupts();

/// Whether ^C came.
bool interrupted();

/// Options of a run that tells its progress on standard error and stops at ^C.
harness::RunOptions interactive_options(const std::string& title);

/// Exit code of a program that the caught signal ended.
int interruption_code();

/// Says what there is, and returns the exit code.
int report_interruption(const harness::RunOutcome& outcome, const std::filesystem::path& folder);

}  // namespace vinebench::tools
