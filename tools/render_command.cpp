// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "harness/jobs/render_view.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"
#include "tools/interactive.h"

namespace vinebench::tools {
namespace {

using harness::ViewRequest;

void add_truth_options(CLI::App& command, ViewRequest& arguments) {
  command.add_option("--labels", arguments.labels, "Also write what each pixel shows, in colours");
  command.add_option("--depth", arguments.depth, "Also write the depth, 16-bit PNG in mm");
  command.add_option("--instances", arguments.instances,
                     "Also write which plant, bunch or thing each pixel shows, in colours");
  command.add_option("--normals", arguments.normals,
                     "Also write the surfaces' normals (red right, green up, blue to the camera)");
  command.add_option("--flow", arguments.flow,
                     "Also write the optical flow to the view of --flow-to: .flo, or .png in "
                     "colours");
  command.add_option("--flow-to", arguments.flow_to, "X,Y,Z,YAW[,PITCH], as --pose");
  command.add_option("--flow-visible", arguments.flow_visible,
                     "Also write where that view still shows what a pixel shows, in white");
  command.add_option("--disparity", arguments.disparity,
                     "Also write the disparity to a right camera, 16-bit PNG in 1/256 px");
  command.add_option("--baseline", arguments.baseline, "m from the camera to that right camera")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void add_rover_options(CLI::App& command, ViewRequest& arguments) {
  command.add_option("--rover", arguments.rover,
                     "X,Y,Z,YAW[,PITCH] in m and degrees: also show a rover that stands there");
  command.add_option("--rover-to", arguments.rover_to, "Where it stands in the view of --flow-to");
  command.add_option("--rover-file", arguments.rover_file, "Which rover (YAML)")
      ->capture_default_str();
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ViewRequest>();
  const auto overrides = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("render", "Make an image of a world");
  command->add_option("WORLD", arguments->world, "World file (YAML)")->required();
  command->add_option("--out", arguments->out, "Image to write, .png or .jpg")->required();
  command->add_option("--pose", arguments->pose,
                      "X,Y,Z,YAW[,PITCH] in m and degrees: the camera's place and view, or with "
                      "--rig the rover's");
  command->add_option("--camera", arguments->camera,
                      "WIDTHxHEIGHT@FOCAL in pixels (default 752x480@263.2786), or with --rig the "
                      "name of its camera");
  command->add_option("--rig", arguments->rig, "Rig file (YAML) whose camera to use");
  add_truth_options(*command, *arguments);
  add_rover_options(*command, *arguments);
  command->add_flag("--turntable", arguments->turntable, "Eight views from all round on one sheet");
  command->add_option("--seed", arguments->seed, "Seed of plants, ground and sky")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  command
      ->add_option("--set", *overrides,
                   "Set a key of the world, e.g. sun.elevation_deg=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([&chosen, arguments, overrides] {
    chosen = [arguments, overrides] {
      arguments->overrides = parse_overrides(*overrides);
      arguments->gl_platform = gl_variable();
      harness::render_view(*arguments);
      return 0;
    };
  });
}

}  // namespace vinebench::tools
