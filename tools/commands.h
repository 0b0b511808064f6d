// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace vinebench::tools {

inline constexpr int kExpectationFailed = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kInternalError = 3;

/// What the command line asks for; its result is the program's exit code.
using Command = std::function<int()>;

// Each adds its sub-command to the program; parsing one of them sets `chosen`.
void add_run_command(CLI::App& app, Command& chosen);
void add_replay_command(CLI::App& app, Command& chosen);
void add_record_command(CLI::App& app, Command& chosen);
void add_check_command(CLI::App& app, Command& chosen);
void add_eval_command(CLI::App& app, Command& chosen);
void add_compare_command(CLI::App& app, Command& chosen);
void add_render_command(CLI::App& app, Command& chosen);
void add_bench_command(CLI::App& app, Command& chosen);
void add_world_command(CLI::App& app, Command& chosen);

/// Sub-commands of bench in files of their own.
void add_bench_render(CLI::App& bench, Command& chosen);
void add_bench_slam(CLI::App& bench, Command& chosen);
void add_bench_record(CLI::App& bench, Command& chosen);

}  // namespace vinebench::tools
