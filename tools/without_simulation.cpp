// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "core/util/error.h"
#include "tools/commands.h"
#include "tools/simulation.h"

namespace vinebench::tools {
namespace {

[[noreturn]] void refuse(const std::string& command) {
  fail("{}: this build has no simulation (-DVINEBENCH_SIM=OFF)", command);
}

/// A command that takes any arguments and says why it does nothing.
void add_refusal(CLI::App& app, Command& chosen, const std::string& name) {
  CLI::App* command = app.add_subcommand(name, "Needs the simulation, which this build lacks");
  command->allow_extras();
  command->callback([&chosen, name] { chosen = [name]() -> int { refuse(name); }; });
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  add_refusal(app, chosen, "run");
}

void add_record_command(CLI::App& app, Command& chosen) {
  add_refusal(app, chosen, "record");
}

void add_render_command(CLI::App& app, Command& chosen) {
  add_refusal(app, chosen, "render");
}

void add_world_command(CLI::App& app, Command& chosen) {
  add_refusal(app, chosen, "world");
}

void add_bench_render(CLI::App& bench, Command& chosen) {
  add_refusal(bench, chosen, "render");
}

void add_bench_record(CLI::App& bench, Command& chosen) {
  add_refusal(bench, chosen, "record");
}

std::vector<std::pair<std::string, std::string>> simulation_versions() {
  return {};
}

void simulate_frames(const SimulatedFrames&, harness::SlamBenchmark&) {
  refuse("bench slam without a DATASET");
}

}  // namespace vinebench::tools
