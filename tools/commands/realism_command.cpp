// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "harness/realism/measure_realism.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

const std::vector<std::string> kViews{"side", "ahead"};

struct RealismArguments {
  harness::RealismRequest request;
  std::string view = "side";
  std::string fit;
  std::vector<std::string> overrides;
  std::filesystem::path cache;
};

int measure(const RealismArguments& arguments, const Surroundings& surroundings) {
  harness::RealismRequest request = arguments.request;
  request.view = arguments.view == "side" ? harness::ViewKind::kSide : harness::ViewKind::kAhead;
  request.overrides = parse_overrides(arguments.overrides);
  request.machine = with_cache(surroundings.machine, arguments.cache);
  if (request.out.empty()) request.out = "out/realism";
  request.told = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  if (arguments.fit.empty()) {
    fmt::print("{}", harness::measure_realism(request, surroundings.catalogue));
  } else {
    request.fit = surroundings.catalogue.find(harness::DataKind::kRandomisation, arguments.fit);
    fmt::print("{}", harness::fit_realism(request, surroundings.catalogue));
  }
  fmt::print("results: {}\n", std::filesystem::absolute(request.out).string());
  return 0;
}

std::vector<Option> picture_options(RealismArguments& arguments) {
  harness::RealismRequest& request = arguments.request;
  return {{.name = "PHOTOS",
           .target = &request.photographs,
           .help = "Folder of real photographs, or a .json file of their numbers",
           .required = true},
          {.name = "--ours",
           .target = &request.ours,
           .help = "Scenarios, worlds, folders of pictures or files of numbers to compare",
           .required = true},
          {.name = "--view",
           .target = &arguments.view,
           .help = "How scenarios and worlds are looked at",
           .show_default = true,
           .choices = kViews},
          {.name = "--images",
           .target = &request.images,
           .help = "Pictures of each scenario or world",
           .show_default = true,
           .range = Range::between(1, 10000)},
          {.name = "--width",
           .target = &request.width,
           .help = "Pixels that photographs are scaled to; a file of numbers has its own",
           .show_default = true,
           .range = Range::between(128, 4096)},
          {.name = "--seed",
           .target = &request.seed,
           .help = "Seed of plants and viewpoints",
           .show_default = true,
           .range = Range::non_negative()},
          overrides_option(arguments.overrides, "Set a key of the scenarios or worlds")};
}

std::vector<Option> result_options(RealismArguments& arguments) {
  harness::RealismRequest& request = arguments.request;
  return {{.name = "--out",
           .target = &request.out,
           .help = "Folder for page, table and pictures (default: out/realism)",
           .type = "FOLDER"},
          {.name = "--save",
           .target = &request.save,
           .help = "Also write the photographs' numbers, without the pictures",
           .type = "FILE"},
          {.name = "--fit",
           .target = &arguments.fit,
           .help = "Search in this randomisation for settings that come nearest, and write them "
                   "as one: fitted.yaml",
           .data = harness::DataKind::kRandomisation},
          {.name = "--draws",
           .target = &request.draws,
           .help = "Settings that --fit tries",
           .show_default = true,
           .range = Range::between(8, 100000)},
          threads_option(request.threads),
          cache_option(arguments.cache)};
}

}  // namespace

Command realism_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<RealismArguments>();
  arguments->request.threads = default_threads();
  Command command{.name = "realism",
                  .description = "Measure how far simulated pictures resemble real photographs",
                  .options = picture_options(*arguments),
                  .run = [arguments, surroundings] { return measure(*arguments, surroundings); }};
  append(command.options, result_options(*arguments));
  return command;
}

}  // namespace vinebench::tools
