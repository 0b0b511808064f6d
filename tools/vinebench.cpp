// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/util/error.h"
#include "tools/commands.h"
#include "tools/versions.h"

namespace vinebench::tools {
namespace {

int dispatch(int argc, char** argv) {
  CLI::App app{"Deterministic test bench for multicamera visual SLAM in vineyards", "vinebench"};
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", [] { return versions_text(); });  // starts OpenGL
  Command chosen;
  add_run_command(app, chosen);
  add_replay_command(app, chosen);
  add_record_command(app, chosen);
  add_check_command(app, chosen);
  add_eval_command(app, chosen);
  add_compare_command(app, chosen);
  add_render_command(app, chosen);
  add_bench_command(app, chosen);
  add_world_command(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  if (!chosen) fail("expected a sub-command, such as run or render (see --help)");
  return chosen();
}

}  // namespace
}  // namespace vinebench::tools

int main(int argc, char** argv) {
  try {
    return vinebench::tools::dispatch(argc, argv);
  } catch (const vinebench::Error& error) {
    fmt::print(stderr, "vinebench: {}\n", error.what());
    return vinebench::tools::kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vinebench: internal error: {}\n", error.what());
    return vinebench::tools::kInternalError;
  }
}
