// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/interactive.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
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

std::vector<Override> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  for (const std::string& text : texts) overrides.push_back(parse_override(text));
  return overrides;
}

void add_map_options(CLI::App& command, harness::MapFiles& maps) {
  command.add_option("--load-map", maps.load, "Map of an earlier run to go on with")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command.add_option("--save-map", maps.save, "File for the map in the end")->type_name("FILE");
  command.add_option("--save-cloud", maps.cloud, "File for its landmarks (PLY)")->type_name("FILE");
}

}  // namespace vinebench::tools
