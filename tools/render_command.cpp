// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "scenarios/run_scenario.h"
#include "scenarios/snapshot.h"
#include "sim/renderer.h"
#include "slam/base/error.h"
#include "slam/base/rig.h"
#include "tools/commands.h"

namespace vinebench {
namespace {

struct RenderArguments {
  std::string world;
  std::string pose;
  std::string camera;
  std::string rig;
  std::string out;
  std::string labels;
  std::string depth;
  std::vector<std::string> overrides;
  std::int64_t seed = 1;
  bool turntable = false;
};

/// The camera and where it is against the frame that --pose places.
RigCamera camera_of(const RenderArguments& arguments) {
  if (arguments.rig.empty()) {
    const std::string text = arguments.camera.empty() ? "752x480@263.2786" : arguments.camera;
    return {"camera", parse_camera(text), Rig::mount({0, 0, 0}, {0, 0, 0})};
  }
  const Rig rig = load_rig(arguments.rig);
  const int index = arguments.camera.empty() ? 0 : rig.find_camera(arguments.camera);
  if (index < 0) fail("{}: no camera is named '{}'", arguments.rig, arguments.camera);
  return rig.cameras[static_cast<std::size_t>(index)];
}

int render(const RenderArguments& arguments) {
  std::vector<Override> overrides;
  for (const std::string& text : arguments.overrides) overrides.push_back(parse_override(text));
  const WorldConfig world = load_world(arguments.world, overrides);
  const auto seed = static_cast<std::uint64_t>(arguments.seed);
  const RigCamera camera = camera_of(arguments);
  if (arguments.turntable) {
    write_picture(arguments.out, turntable(world, seed, camera.model));
    return 0;
  }
  if (arguments.pose.empty()) fail("render: expected --pose X,Y,Z,YAW or --turntable");
  const Pose T_world_cam = parse_view(arguments.pose) * camera.T_body_cam;
  Renderer renderer(build_scene(world, seed, default_cache()), {});
  Renderer::Request request;
  request.labels = !arguments.labels.empty();
  request.depth = !arguments.depth.empty();
  const Picture picture = renderer.render(camera.model, T_world_cam, request);
  write_picture(arguments.out, picture.rgb);
  if (request.labels) write_picture(arguments.labels, colour_labels(picture.labels));
  if (request.depth) write_picture(arguments.depth, picture.depth);
  return 0;
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Make a picture of a world");
  command->add_option("WORLD", arguments->world, "World file (YAML)")->required();
  command->add_option("--out", arguments->out, "Picture to write, .png or .jpg")->required();
  command->add_option("--pose", arguments->pose,
                      "X,Y,Z,YAW[,PITCH] in m and degrees: the camera's place and view, or with "
                      "--rig the rover's");
  command->add_option("--camera", arguments->camera,
                      "WIDTHxHEIGHT@FOCAL in pixels (default 752x480@263.2786), or with --rig the "
                      "name of its camera");
  command->add_option("--rig", arguments->rig, "Rig file (YAML) whose camera to use");
  command->add_option("--labels", arguments->labels,
                      "Also write what each pixel shows, in colours");
  command->add_option("--depth", arguments->depth, "Also write the depth, 16-bit PNG in mm");
  command->add_flag("--turntable", arguments->turntable, "Eight views from all round on one sheet");
  command->add_option("--seed", arguments->seed, "Seed of plants, ground and sky")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  command
      ->add_option("--set", arguments->overrides,
                   "Set a key of the world, e.g. sun.elevation_deg=20; may stand many times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([&chosen, arguments] { chosen = [arguments] { return render(*arguments); }; });
}

}  // namespace vinebench
