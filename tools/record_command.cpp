// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "harness/datasets/formats.h"
#include "harness/jobs/record.h"
#include "harness/run.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"
#include "tools/interactive.h"

namespace vinebench::tools {
namespace {

struct RecordArguments {
  harness::RecordRequest request;
  std::vector<std::string> overrides;
  std::vector<std::string> formats;
  std::vector<std::string> labels;
  std::string seeds;
  std::string frames;
  std::string images;
};

harness::RecordRequest request_of(const RecordArguments& arguments) {
  harness::RecordRequest request = arguments.request;
  request.overrides = parse_overrides(arguments.overrides);
  request.gl_backend = gl_variable();
  request.options.formats = harness::parse_formats(arguments.formats);
  request.options.categories = harness::parse_categories(arguments.labels);
  if (!arguments.seeds.empty()) request.seeds = harness::parse_span(arguments.seeds, "--seeds");
  if (!arguments.frames.empty()) {
    std::tie(request.options.first, request.options.last) =
        harness::parse_span(arguments.frames, "--frames");
  }
  const std::vector<std::string> kinds = yaml_names(harness::ImageKind{});
  if (!arguments.images.empty()) {
    request.options.images =
        static_cast<harness::ImageKind>(std::ranges::find(kinds, arguments.images) - kinds.begin());
  }
  return request;
}

int record(const RecordArguments& arguments) {
  const harness::RecordRequest request = request_of(arguments);
  catch_interrupts();
  const harness::RunOptions watch = interactive_options("record");
  const harness::RecordOutcome outcome =
      harness::record_dataset(request, {watch.progress, watch.terminal, watch.stopped});
  const std::string there =
      fmt::format("{} frames, {:.1f} MB", outcome.frames, static_cast<double>(outcome.bytes) / 1e6);
  if (outcome.interrupted) {
    fmt::print(stderr,
               "vinebench: stopped after {}; what there is of them is in {}, and --resume "
               "goes on\n",
               there, request.out.string());
    return interruption_code();
  }
  fmt::print("{}: {}", request.out.string(), there);
  if (outcome.skipped > 0) fmt::print("; {} sequences were complete", outcome.skipped);
  fmt::print("\n");
  return 0;
}

void add_what(CLI::App& command, RecordArguments& arguments) {
  harness::RecordOptions& options = arguments.request.options;
  std::vector<std::string> names;
  for (const harness::DatasetFormat& format : harness::dataset_formats()) {
    names.push_back(format.name);
  }
  command
      .add_option("--format", arguments.formats,
                  fmt::format("Some of {}; commas between them", fmt::join(names, ", ")))
      ->required()
      ->delimiter(',');
  command.add_option("--cameras", options.cameras, "Names of cameras of the rig (default: all)")
      ->delimiter(',');
  command
      .add_option("--labels", arguments.labels,
                  "Kinds of things in COCO's instances.json, such as bunch,post (default: all)")
      ->delimiter(',');
  command.add_option("--frames", arguments.frames, "Frames of the run, from 0 on (default: all)")
      ->type_name("A..B");
  command.add_option("--every", options.every, "Only every n-th of them")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}))
      ->capture_default_str();
  command
      .add_option("--image", arguments.images,
                  "Images of rgb, coco and ros: png, jpg, webp (default: png; ros's are raw)")
      ->check(CLI::IsMember(yaml_names(harness::ImageKind{})));
  command.add_flag("--colour", options.colour,
                   "Images of euroc, dcvslam and ros in colour; kitti's also in colour");
}

}  // namespace

void add_record_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<RecordArguments>();
  harness::RecordRequest& request = arguments->request;
  request.options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* command =
      app.add_subcommand("record", "Simulate a scenario, without SLAM, into a data set");
  command->add_option("SCENARIO", request.scenario, "Scenario file (YAML)")->required();
  command->add_option("--out", request.out, "New or empty folder for the data set")->required();
  add_what(*command, *arguments);
  command
      ->add_option("--seeds", arguments->seeds,
                   "Seeds, each a sequence in a folder of its own (default: the scenario's alone)")
      ->type_name("A..B");
  command->add_option("--randomise", request.randomisation,
                      "File of distributions from which each seed draws keys of the scenario");
  command
      ->add_option("--set", arguments->overrides,
                   "Set a key of the scenario, e.g. duration=2; may stand many times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--jobs", request.options.threads, "Threads that draw, and that encode")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_flag("--resume", request.resume,
                    "Go on with an interrupted recording: what is complete is kept");
  command->footer("Exit code: 0 when all is recorded, 2 for bad input, 130 when interrupted.");
  command->callback([&chosen, arguments] { chosen = [arguments] { return record(*arguments); }; });
}

}  // namespace vinebench::tools
