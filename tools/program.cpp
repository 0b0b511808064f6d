// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

/// Stands in the list of commands; the command line turns `help COMMAND` into `COMMAND --help`.
Command help_command() {
  const auto words = std::make_shared<std::vector<std::string>>();
  return {.name = "help",
          .description = "Describe a command and its options",
          .options = {{.name = "COMMAND", .target = words.get(), .help = "Its name"}},
          .run = [words] { return 0; }};
}

}  // namespace

Command program(const Surroundings& surroundings) {
  Command bench{.name = "bench",
                .description = "Measure the speed of a part",
                .commands = {bench_render_command(surroundings), bench_slam_command(surroundings),
                             bench_record_command(surroundings)}};
  return {.name = "vinebench",
          .description = "Deterministic test bench for multicamera visual SLAM in vineyards",
          .commands = {run_command(surroundings),
                       replay_command(surroundings),
                       record_command(surroundings),
                       check_command(),
                       eval_command(),
                       compare_command(),
                       report_command(),
                       plan_command(),
                       guard_command(surroundings),
                       sweep_command(surroundings),
                       dataset_command(surroundings),
                       search_command(surroundings),
                       place_tags_command(),
                       place_camera_command(),
                       explain_command(surroundings),
                       realism_command(surroundings),
                       render_command(surroundings),
                       std::move(bench),
                       world_command(),
                       list_command(surroundings),
                       reference_command(surroundings),
                       help_command()}};
}

}  // namespace vinebench::tools
