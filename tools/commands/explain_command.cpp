// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "core/files/files.h"
#include "harness/datasets/files/json_file.h"
#include "harness/explain/explanation_text.h"
#include "harness/explain/run_to_explain.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

struct ExplainArguments {
  std::filesystem::path folder;
  std::optional<std::int64_t> stretch;
  double from = -1;
  double to = -1;
  double lead = 2;
  int placebos = 4;
  int pairs = 10;
  int threads = default_threads();
  std::filesystem::path cache;
};

int explain_run(const ExplainArguments& arguments, const Surroundings& surroundings) {
  harness::StretchChoice choice{.number = arguments.stretch, .from = {}, .to = {}};
  if (arguments.from >= 0) choice.from = arguments.from;
  if (arguments.to >= 0) choice.to = arguments.to;
  harness::ExplainRequest request = harness::read_run(arguments.folder, choice);
  request.machine = with_cache(surroundings.machine, arguments.cache);
  sim::choose_backend(request.scenario.simulation.renderer, request.machine.gl_platform);
  request.lead = arguments.lead;
  request.placebos = arguments.placebos;
  request.pairs = arguments.pairs;
  request.at_once = arguments.threads;
  request.progress = &std::cerr;
  const double rate_hz = load_rig(request.scenario.simulation.rover.rig).rate_hz;
  const harness::Explanation explanation = harness::explain(request);
  write_file_atomically(arguments.folder / "explanation.json",
                        harness::json_text(harness::to_json(explanation, rate_hz), 2) + "\n");
  fmt::print("{}", harness::format_explanation(explanation, rate_hz));
  return 0;
}

std::vector<Option> choice_options(ExplainArguments& arguments) {
  return {{.name = "RUN",
           .target = &arguments.folder,
           .help = "Folder of a run",
           .required = true,
           .existing = Existing::kFolder},
          {.name = "--stretch",
           .target = &arguments.stretch,
           .help = "Number of a degraded segment, as the run lists them (default: all of them, or "
                   "the whole drive if there is none)",
           .range = Range::between(1, 1e6),
           .excludes = "--from"},
          {.name = "--from",
           .target = &arguments.from,
           .help = "Begin of another stretch, s",
           .range = Range::non_negative()},
          {.name = "--to",
           .target = &arguments.to,
           .help = "End of another stretch, s",
           .range = Range::non_negative(),
           .excludes = "--stretch"}};
}

}  // namespace

Command explain_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<ExplainArguments>();
  Command command{
      .name = "explain",
      .description = "Find what caused a run's error, by repeating it without one factor at a time",
      .options = choice_options(*arguments),
      .run = [arguments, surroundings] { return explain_run(*arguments, surroundings); }};
  append(command.options,
         {{.name = "--lead",
           .target = &arguments->lead,
           .help = "Seconds before a stretch from which on a factor is absent",
           .show_default = true,
           .range = Range::between(0, 1e6)},
          {.name = "--placebos",
           .target = &arguments->placebos,
           .help = "Repetitions with another noise, which measure chance",
           .show_default = true,
           .range = Range::between(2, 1000)},
          {.name = "--pairs",
           .target = &arguments->pairs,
           .help = "Pairs of factors to try at most, where single ones do not add up",
           .show_default = true,
           .range = Range::between(0, 1000)},
          threads_option(arguments->threads),
          cache_option(arguments->cache)});
  return command;
}

}  // namespace vinebench::tools
