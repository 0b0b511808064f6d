// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "tools/commands.h"

namespace vinebench::tools {

void add_bench_command(CLI::App& app, Command& chosen) {
  CLI::App* bench = app.add_subcommand("bench", "Measure the speed of a part");
  bench->require_subcommand(1);
  add_bench_render(*bench, chosen);
  add_bench_slam(*bench, chosen);
  add_bench_record(*bench, chosen);
}

}  // namespace vinebench::tools
