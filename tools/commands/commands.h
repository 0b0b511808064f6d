// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/arguments/command.h"

namespace vinebench::tools {

// The program's commands. Their options' targets live as long as the command.

Command run_command(const Surroundings& surroundings);
Command replay_command(const Surroundings& surroundings);
Command record_command(const Surroundings& surroundings);
Command check_command();
Command eval_command();
Command compare_command();
Command report_command();
Command plan_command();
Command guard_command(const Surroundings& surroundings);
Command sweep_command(const Surroundings& surroundings);
Command dataset_command(const Surroundings& surroundings);
Command search_command(const Surroundings& surroundings);
Command place_tags_command();
Command place_camera_command();
Command explain_command(const Surroundings& surroundings);
Command render_command(const Surroundings& surroundings);
Command realism_command(const Surroundings& surroundings);
Command world_command();
Command list_command(const Surroundings& surroundings);
Command reference_command(const Surroundings& surroundings);

Command bench_render_command(const Surroundings& surroundings);
Command bench_slam_command(const Surroundings& surroundings);
Command bench_record_command(const Surroundings& surroundings);

/// All of them, as the program `vinebench`.
Command program(const Surroundings& surroundings);

}  // namespace vinebench::tools
