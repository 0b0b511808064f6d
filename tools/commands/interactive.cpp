// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/interactive.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace vinebench::tools {
namespace {

constexpr int kSignalBase = 128;  // a shell's convention for a program that a signal ended

volatile sig_atomic_t g_signal = 0;

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { g_signal = signal; };
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
  return g_signal != 0;
}

harness::RunOptions interactive_options(const std::string& title) {
  harness::RunOptions options;
  options.progress = &std::cerr;
  options.terminal = isatty(STDERR_FILENO) == 1;
  options.title = title;
  options.stopped = interrupted;
  return options;
}

int interruption_code() {
  return kSignalBase + g_signal;
}

int report_interruption(const harness::RunOutcome& outcome, const std::filesystem::path& folder) {
  fmt::print(stderr, "vinebench: stopped after {} frames; what there is of them is in {}\n",
             outcome.report.frames, folder.string());
  return interruption_code();
}

}  // namespace vinebench::tools
