// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "harness/jobs/make_world.h"
#include "tools/commands.h"

namespace vinebench::tools {
namespace {

using harness::WorldRequest;

/// An option that takes the name of one of an enum's values.
template <class Enum>
void add_choice(CLI::App& command, const char* option, Enum& value, const char* help) {
  const std::vector<std::string> names = yaml_names(Enum{});
  command
      .add_option_function<std::string>(
          option,
          [&value, names](const std::string& name) {
            value = static_cast<Enum>(std::ranges::find(names, name) - names.begin());
          },
          help)
      ->check(CLI::IsMember(names))
      ->default_str(names.at(static_cast<std::size_t>(value)));
}

void add_layout(CLI::App& command, sim::WorldRecipe& recipe) {
  command.add_option("--rows", recipe.rows, "Rows")->capture_default_str();
  command.add_option("--length", recipe.length, "Length of a row, m")->capture_default_str();
  command.add_option("--row-spacing", recipe.row_spacing, "Between rows, m")->capture_default_str();
  command.add_option("--plant-spacing", recipe.plant_spacing, "Between vines, m")
      ->capture_default_str();
  command.add_option("--heading", recipe.heading_deg, "Of the rows from east over north, degrees")
      ->capture_default_str();
  add_choice(command, "--terrain", recipe.terrain, "Shape of the ground");
  command.add_option("--slope", recipe.slope_percent, "Rise over run, percent")
      ->capture_default_str();
}

void add_content(CLI::App& command, sim::WorldRecipe& recipe) {
  command.add_option("--bbch", recipe.bbch, "Growth stage: 0, 9, 65, 75, 83, 89 or 95")
      ->capture_default_str();
  command.add_option("--templates", recipe.templates, "Different plants")->capture_default_str();
  add_choice(command, "--tags", recipe.tags,
             "None, the first post of all, the ends of every row, or all posts");
  command.add_option("--tag-family", recipe.tag_family, "AprilTag family")->capture_default_str();
  command.add_option("--tag-size", recipe.tag_size, "Side of the black square, m")
      ->capture_default_str();
  command.add_option("--cartons", recipe.cartons, "Carton boxes in the aisles")
      ->capture_default_str();
  command.add_option("--people", recipe.people, "People in the aisles")->capture_default_str();
  command.add_option("--seed", recipe.seed, "Seed of ground, slope, cartons and people")
      ->capture_default_str();
}

}  // namespace

void add_world_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<WorldRequest>();
  CLI::App* command = app.add_subcommand("world", "Write the file of a new vineyard");
  command->add_option("NAME", arguments->recipe.name, "Name of the world")->required();
  command->add_option("--out", arguments->out, "File to write (default NAME.yaml)");
  command->add_flag("--force", arguments->force, "Overwrite the file where it exists");
  add_layout(*command, arguments->recipe);
  add_content(*command, arguments->recipe);
  command->callback([&chosen, arguments] {
    chosen = [arguments] {
      fmt::print("{}", harness::make_world(*arguments));
      return 0;
    };
  });
}

}  // namespace vinebench::tools
