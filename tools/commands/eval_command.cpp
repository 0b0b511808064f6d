// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "core/util/error.h"
#include "harness/harness.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

int eval(const std::string& truth_file, const std::string& estimate_file) {
  const Trajectory truth = read_tum(truth_file);
  const Trajectory estimate = read_tum(estimate_file);
  const std::optional<harness::Evaluation> evaluation = harness::evaluate(truth, estimate);
  if (!evaluation) {
    fail("{}: fewer than three of its {} poses are within 0.01 s of one of {}", estimate_file,
         estimate.size(), truth_file);
  }
  const auto print = [](const char* name, double value) {
    fmt::print("{:<20} {:.9f}\n", name, value);
  };
  fmt::print("{:<20} {}\n", "poses", evaluation->pairs);
  print("ate_rmse_m", evaluation->ate.rmse);
  print("ate_mean_m", evaluation->ate.mean);
  print("ate_median_m", evaluation->ate.median);
  print("ate_max_m", evaluation->ate.max);
  print("ate_origin_rmse_m", evaluation->origin.rmse);
  if (evaluation->rpe_trans_percent) print("rpe_trans_percent", *evaluation->rpe_trans_percent);
  return 0;
}

}  // namespace

Command eval_command() {
  const auto files = std::make_shared<std::pair<std::string, std::string>>();
  return {.name = "eval",
          .description = "Compare two trajectories in TUM format",
          .options = {{.name = "GROUNDTRUTH",
                       .target = &files->first,
                       .help = "True trajectory (TUM)",
                       .required = true},
                      {.name = "ESTIMATE",
                       .target = &files->second,
                       .help = "Estimated trajectory (TUM)",
                       .required = true}},
          .run = [files] { return eval(files->first, files->second); }};
}

}  // namespace vinebench::tools
