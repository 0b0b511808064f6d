// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/placement/plan_files.h"
#include "harness/placement/planned_drive.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

struct PlaceTagsArguments {
  std::string world;
  std::string route;
  std::int64_t budget = 10;
  double error_mm = 0;
  double height = 0.5;
  double size = 0.161;
  double drift_offset_mm = 1;
  double drift_turn_mrad = 0.2;
  double survey_position = 0;
  double survey_rotation_deg = 0;
  std::string out = "out/tags";
  std::vector<std::filesystem::path> data_folders;
};

void tell(const char* what, std::size_t tags, const harness::TagPlan& plan) {
  fmt::print("{:<22} {:>4} tags  95 % of the poses within {:>7.1f} mm  {:>8.1f} nats\n", what, tags,
             1e3 * plan.error, plan.information);
}

int place_tags(const PlaceTagsArguments& arguments) {
  const harness::PlannedDrive drive = harness::plan_drive(
      arguments.world, arguments.route,
      {1e-3 * arguments.drift_offset_mm, 1e-3 * arguments.drift_turn_mrad},
      {arguments.survey_position, arguments.survey_rotation_deg * std::numbers::pi / 180});
  const FolderLock lock(arguments.out);
  const auto candidates = harness::post_candidates(drive, arguments.height, arguments.size);
  const auto own = harness::own_tags(drive);
  const auto seen = std::ranges::count_if(
      candidates, [](const harness::TagCandidate& tag) { return !tag.information.empty(); });
  fmt::print("{} poses over the route; {} of {} places on posts are seen\n", drive.poses.size(),
             seen, candidates.size());
  tell("without tags", 0, harness::predict_tags(drive.chain, {}));
  if (!own.empty()) tell("the world's own", own.size(), harness::predict_tags(drive.chain, own));
  harness::TagDemand demand;
  demand.budget = static_cast<int>(arguments.budget);
  if (arguments.error_mm > 0) {
    demand.error = 1e-3 * arguments.error_mm;
    demand.budget = static_cast<int>(candidates.size());
  }
  const harness::TagPlan plan = harness::plan_tags(drive.chain, candidates, demand);
  const auto tags = harness::planned_tags(candidates, plan);
  tell("planned", tags.size(), plan);
  fmt::print("no other {} tags have more than {:.1f} nats\n", tags.size(), plan.most_information);
  const std::filesystem::path out = arguments.out;
  write_file_atomically(out / "world.yaml", harness::with_tags(read_file(arguments.world), tags));
  write_file_atomically(out / "tags.csv", harness::tag_list(tags));
  write_file_atomically(out / "plan.svg",
                        harness::plan_svg(drive.world(), drive.poses, tags, plan));
  fmt::print("world.yaml, tags.csv and plan.svg are in {}\n",
             std::filesystem::absolute(out).string());
  if (demand.error && plan.error > *demand.error) {
    fmt::print(stderr, "vinebench: with all places that are seen, {:.1f} mm remain\n",
               1e3 * plan.error);
    return kExpectationFailed;
  }
  return 0;
}

}  // namespace

Command place_tags_command() {
  const auto arguments = std::make_shared<PlaceTagsArguments>();
  std::vector<Option> options = drive_options(arguments->world, arguments->route);
  append(
      options,
      {{.name = "--budget",
        .target = &arguments->budget,
        .help = "So many tags",
        .show_default = true,
        .range = Range::between(1, 500),
        .excludes = "--error"},
       {.name = "--error",
        .target = &arguments->error_mm,
        .help = "mm: as few tags as keep 95 % of the poses within it",
        .range = Range::positive()},
       {.name = "--height",
        .target = &arguments->height,
        .help = "m above the ground",
        .show_default = true,
        .range = Range::between(0.05, 6)},
       {.name = "--size",
        .target = &arguments->size,
        .help = "m, side of a tag's black square",
        .show_default = true,
        .range = Range::between(0.01, 5)},
       {.name = "--drift-offset",
        .target = &arguments->drift_offset_mm,
        .help = "mm that the odometry is off by after a metre; it grows with the root of the way",
        .show_default = true,
        .range = Range::positive()},
       {.name = "--drift-turn",
        .target = &arguments->drift_turn_mrad,
        .help = "mrad, likewise",
        .show_default = true,
        .range = Range::positive()},
       {.name = "--survey-position",
        .target = &arguments->survey_position,
        .help = "m, accuracy of a tag's survey along each axis",
        .show_default = true,
        .range = Range::non_negative()},
       {.name = "--survey-rotation",
        .target = &arguments->survey_rotation_deg,
        .help = "degrees, likewise about each axis",
        .show_default = true,
        .range = Range::non_negative()},
       {.name = "--out",
        .target = &arguments->out,
        .help = "Folder for world.yaml, tags.csv and plan.svg",
        .type = "FOLDER",
        .show_default = true}});
  return {.name = "place-tags",
          .description = "Plan where tags hang in a vineyard, by the predicted error along a route",
          .options = options,
          .footer =
              "Exit code: 0, or 1 when all tags together do not keep the --error, 2 for bad input.",
          .run = [arguments] { return place_tags(*arguments); }};
}

}  // namespace vinebench::tools
