// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/jobs/make_world.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

using harness::WorldRequest;

struct WorldArguments {
  WorldRequest request;
  std::string terrain;
  std::string tags;
};

/// An option that takes the name of one of an enum's values; `name` is the default's.
template <class Enum>
Option choice(const char* option, Enum value, std::string& name, const char* help) {
  const std::vector<std::string> names = yaml_names(Enum{});
  name = names.at(static_cast<std::size_t>(value));
  return {.name = option, .target = &name, .help = help, .show_default = true, .choices = names};
}

int world(const WorldArguments& arguments) {
  WorldRequest request = arguments.request;
  choose(request.recipe.terrain, arguments.terrain);
  choose(request.recipe.tags, arguments.tags);
  fmt::print("{}", harness::make_world(request));
  return 0;
}

Option number(const char* name, OptionTarget target, const char* help) {
  return {.name = name, .target = target, .help = help, .show_default = true};
}

std::vector<Option> layout_options(sim::WorldRecipe& recipe, std::string& terrain) {
  return {number("--rows", &recipe.rows, "Rows"),
          number("--length", &recipe.length, "Length of a row, m"),
          number("--row-spacing", &recipe.row_spacing, "Between rows, m"),
          number("--plant-spacing", &recipe.plant_spacing, "Between vines, m"),
          number("--heading", &recipe.heading_deg, "Of the rows from east over north, degrees"),
          choice("--terrain", recipe.terrain, terrain, "Shape of the ground"),
          number("--slope", &recipe.slope_percent, "Rise over run, percent")};
}

std::vector<Option> content_options(sim::WorldRecipe& recipe, std::string& tags) {
  return {number("--bbch", &recipe.bbch, "Growth stage: 0, 9, 65, 75, 79, 83, 89 or 95"),
          number("--templates", &recipe.templates, "Different plants"),
          choice("--tags", recipe.tags, tags,
                 "None, the first post of all, the ends of every row, or all posts"),
          number("--tag-family", &recipe.tag_family, "AprilTag family"),
          number("--tag-size", &recipe.tag_size, "Side of the black square, m"),
          number("--cartons", &recipe.cartons, "Carton boxes in the aisles"),
          number("--people", &recipe.people, "People in the aisles"),
          number("--seed", &recipe.seed, "Seed of ground, slope, cartons and people")};
}

}  // namespace

Command world_command() {
  const auto arguments = std::make_shared<WorldArguments>();
  WorldRequest& request = arguments->request;
  Command command{.name = "world",
                  .description = "Write the file of a new vineyard",
                  .options = {{.name = "NAME",
                               .target = &request.recipe.name,
                               .help = "Name of the world",
                               .required = true},
                              {.name = "--out",
                               .target = &request.out,
                               .help = "File to write (default: NAME.yaml)"},
                              {.name = "--force",
                               .target = &request.force,
                               .help = "Overwrite the file where it exists"}},
                  .run = [arguments] { return world(*arguments); }};
  append(command.options, layout_options(request.recipe, arguments->terrain));
  append(command.options, content_options(request.recipe, arguments->tags));
  return command;
}

}  // namespace vinebench::tools
