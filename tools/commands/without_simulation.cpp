// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/error.h"
#include "tools/commands/commands.h"
#include "tools/commands/simulation.h"

namespace vinebench::tools {
namespace {

[[noreturn]] void refuse(const std::string& command) {
  fail("{}: this build has no simulation (-DVINEBENCH_SIM=OFF)", command);
}

/// A command that takes any arguments and says why it does nothing.
Command refusal(const std::string& name) {
  return {.name = name,
          .description = "Needs the simulation, which this build lacks",
          .run = [name]() -> int { refuse(name); },
          .any_arguments = true};
}

}  // namespace

Command run_command(const Surroundings&) {
  return refusal("run");
}

Command guard_command(const Surroundings&) {
  return refusal("guard");
}

Command sweep_command(const Surroundings&) {
  return refusal("sweep");
}

Command dataset_command(const Surroundings&) {
  return refusal("dataset");
}

Command search_command(const Surroundings&) {
  return refusal("search");
}

Command place_tags_command() {
  return refusal("place-tags");
}

Command place_camera_command() {
  return refusal("place-camera");
}

Command explain_command(const Surroundings&) {
  return refusal("explain");
}

Command realism_command(const Surroundings&) {
  return refusal("realism");
}

Command record_command(const Surroundings&) {
  return refusal("record");
}

Command render_command(const Surroundings&) {
  return refusal("render");
}

Command world_command() {
  return refusal("world");
}

Command reference_command(const Surroundings&) {
  return refusal("reference");
}

Command bench_render_command(const Surroundings&) {
  return refusal("render");
}

Command bench_record_command(const Surroundings&) {
  return refusal("record");
}

std::vector<std::pair<std::string, std::string>> simulation_versions(const harness::Machine&) {
  return {};
}

void simulate_frames(const SimulatedFrames&, harness::SlamBenchmark&) {
  refuse("bench slam without a DATASET");
}

}  // namespace vinebench::tools
