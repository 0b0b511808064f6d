// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>

#include "harness/datasets/formats.h"
#include "harness/jobs/record.h"
#include "harness/run.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"

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
  std::string quality = "fast";
  std::filesystem::path cache;
  bool untrusted = false;
  std::vector<std::filesystem::path> data_folders;
};

harness::RecordRequest request_of(const RecordArguments& arguments) {
  harness::RecordRequest request = arguments.request;
  request.machine = with_cache(request.machine, arguments.cache);
  request.overrides = parse_overrides(arguments.overrides);
  if (arguments.untrusted) request.untrusted = harness::Untrusted{arguments.data_folders};
  request.options.formats = harness::parse_formats(arguments.formats);
  request.options.categories = harness::parse_categories(arguments.labels);
  if (!arguments.seeds.empty()) request.seeds = harness::parse_span(arguments.seeds, "--seeds");
  if (!arguments.frames.empty()) {
    std::tie(request.options.first, request.options.last) =
        harness::parse_span(arguments.frames, "--frames");
  }
  if (!arguments.images.empty()) {
    harness::ImageKind kind{};
    choose(kind, arguments.images);
    request.options.images = kind;
  }
  choose(request.quality, arguments.quality);
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

std::string format_names() {
  std::vector<std::string> names;
  for (const harness::DatasetFormat& format : harness::dataset_formats()) {
    names.push_back(format.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<Option> content_options(RecordArguments& arguments) {
  harness::RecordOptions& options = arguments.request.options;
  return {{.name = "--format",
           .target = &arguments.formats,
           .help = fmt::format("Some of {}; commas between them", format_names()),
           .required = true,
           .commas = true},
          {.name = "--cameras",
           .target = &options.cameras,
           .help = "Names of cameras of the rig (default: all)",
           .commas = true},
          {.name = "--labels",
           .target = &arguments.labels,
           .help = "Kinds of things in COCO's instances.json, such as bunch,post (default: all)",
           .commas = true},
          {.name = "--least-area",
           .target = &options.least_area,
           .help = "px: smaller things are not in COCO's instances.json",
           .show_default = true,
           .range = Range::between(0, 100'000'000)},
          {.name = "--frames",
           .target = &arguments.frames,
           .help = "Frames of the run, from 0 on (default: all)",
           .type = "A..B"},
          {.name = "--every",
           .target = &options.every,
           .help = "Only every n-th of them",
           .show_default = true,
           .range = Range::between(1, 1'000'000)},
          {.name = "--image",
           .target = &arguments.images,
           .help = "Images of rgb, coco, ros and mcap (default: png; bags' are raw)",
           .choices = yaml_names(harness::ImageKind{})},
          {.name = "--quality",
           .target = &arguments.quality,
           .help = "fine: the finest plants near, and four samples a pixel (renderer.lod_scale 3, "
                   "renderer.supersampling 2)",
           .show_default = true,
           .choices = yaml_names(sim::RenderQuality{})},
          {.name = "--colour",
           .target = &options.colour,
           .help = "Images of euroc, dcvslam, ros and mcap in colour; kitti's also in colour"}};
}

std::vector<Option> request_options(RecordArguments& arguments) {
  harness::RecordRequest& request = arguments.request;
  return {{.name = "SCENARIO",
           .target = &request.scenario,
           .help = "Scenario file (YAML), or the name of a scenario",
           .required = true,
           .data = harness::DataKind::kScenario},
          {.name = "--out",
           .target = &request.out,
           .help = "New or empty folder for the data set",
           .type = "FOLDER",
           .required = true},
          {.name = "--seeds",
           .target = &arguments.seeds,
           .help = "Seeds, each a sequence in a folder of its own (default: the scenario's alone)",
           .type = "A..B"},
          {.name = "--randomise",
           .target = &request.randomisation,
           .help = "Distributions from which each seed draws keys of the scenario: a file, or the "
                   "name of one",
           .data = harness::DataKind::kRandomisation},
          overrides_option(arguments.overrides, "Set a key of the scenario, e.g. duration=2"),
          {.name = "--jobs",
           .target = &request.options.threads,
           .help = "Threads that draw, and that encode",
           .show_default = true,
           .range = Range::between(1, 64)},
          {.name = "--resume",
           .target = &request.resume,
           .help = "Go on with an interrupted recording: what is complete is kept"},
          cache_option(arguments.cache),
          untrusted_option(arguments.untrusted)};
}

}  // namespace

Command record_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<RecordArguments>();
  arguments->request.options.threads = default_threads();
  arguments->request.machine = surroundings.machine;
  arguments->data_folders = surroundings.data_folders;
  Command command{
      .name = "record",
      .description = "Simulate a scenario, without SLAM, into a data set",
      .options = request_options(*arguments),
      .footer = "Exit code: 0 when all is recorded, 2 for bad input, 130 when interrupted.",
      .run = [arguments] { return record(*arguments); }};
  append(command.options, content_options(*arguments));
  return command;
}

}  // namespace vinebench::tools
