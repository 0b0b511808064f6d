// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "core/geometry/rig.h"
#include "core/truth/truth_images.h"
#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/labels/truth_colours.h"
#include "harness/jobs/run_scenario.h"
#include "harness/jobs/snapshot.h"
#include "sim/config_files.h"
#include "sim/render/factory/make_render_engine.h"
#include "sim/rover/rover.h"
#include "sim/rover/rover_asset.h"
#include "sim/sensors/effects/glare.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"

namespace vinebench::tools {
namespace {

struct RenderArguments {
  std::string world;
  std::string pose;
  std::string camera;
  std::string rig;
  std::string out;
  std::string labels;
  std::string depth;
  std::string instances;
  std::string normals;
  std::string flow;
  std::string flow_to;
  std::string flow_visible;
  std::string rover;
  std::string rover_to;
  std::string rover_file = "models/csl-rover/rover.yaml";
  std::string disparity;
  double baseline = 0.12;
  std::vector<std::string> overrides;
  std::int64_t seed = 1;
  bool turntable = false;
};

/// The camera and where it is against the frame that --pose places.
RigCamera camera_of(const RenderArguments& arguments) {
  if (arguments.rig.empty()) {
    const std::string text = arguments.camera.empty() ? "752x480@263.2786" : arguments.camera;
    return {"camera", harness::parse_camera(text), Rig::mount({0, 0, 0}, {0, 0, 0})};
  }
  const Rig rig = load_rig(arguments.rig);
  const int index = arguments.camera.empty() ? 0 : rig.find_camera(arguments.camera);
  if (index < 0) fail("{}: no camera is named '{}'", arguments.rig, arguments.camera);
  return rig.cameras[static_cast<std::size_t>(index)];
}

sim::RendererConfig renderer_config() {
  sim::RendererConfig config;
  sim::choose_backend(config, gl_variable());
  return config;
}

sim::RenderRequest request_of(const RenderArguments& arguments) {
  const bool flows = !arguments.flow.empty() || !arguments.flow_visible.empty();
  const bool warps = flows || !arguments.disparity.empty();
  sim::RenderRequest request;
  request.labels = !arguments.labels.empty();
  request.depth = !arguments.depth.empty() || warps;
  request.instances = !arguments.instances.empty();
  request.normals = !arguments.normals.empty() || warps;
  if (!arguments.rover.empty()) request.T_world_rover = harness::parse_view(arguments.rover);
  if (!arguments.rover_to.empty()) {
    request.T_world_rover_other = harness::parse_view(arguments.rover_to);
    request.motion = flows;
  }
  return request;
}

void write_images(const RenderArguments& arguments, const RenderedImage& image) {
  harness::write_image(arguments.out, image.rgb);
  const auto write = [](const std::string& file, const auto& colours) {
    if (!file.empty()) harness::write_image(file, colours());
  };
  write(arguments.labels, [&] { return harness::colour_labels(image.labels); });
  write(arguments.depth, [&] { return image.depth; });
  write(arguments.instances, [&] { return harness::colour_instances(image.instances); });
  write(arguments.normals, [&] { return harness::colour_normals(image.normals); });
}

/// What takes a second view: flow and disparity.
void write_warps(const RenderArguments& arguments, sim::RenderEngine& renderer,
                 const TruthView& view, const RigCamera& camera) {
  const sim::RenderRequest request = request_of(arguments);
  const auto view_from = [&](const Pose& T_world_cam, const sim::RenderRequest& asked) {
    return TruthView{camera.model, T_world_cam, renderer.render(camera.model, T_world_cam, asked)};
  };
  if (!arguments.flow_to.empty()) {
    sim::RenderRequest later = request;
    if (later.T_world_rover_other) later.T_world_rover = later.T_world_rover_other;
    const Pose there = harness::parse_view(arguments.flow_to) * camera.T_body_cam;
    const FlowTruth truth = optical_flow(view, view_from(there, later));
    if (!arguments.flow.empty()) harness::write_flow(arguments.flow, truth.flow);
    if (!arguments.flow_visible.empty())
      harness::write_image(arguments.flow_visible, truth.visible);
  }
  if (!arguments.disparity.empty()) {
    const Pose T_left_right{Eigen::Quaterniond::Identity(), {arguments.baseline, 0, 0}};
    const TruthView right = view_from(view.T_world_cam * T_left_right, request);
    harness::write_image(arguments.disparity,
                         harness::kitti_disparity(disparity(view, right).disparity));
  }
}

/// The world, and the rover in it where one is asked for.
sim::Scene scene_of(const RenderArguments& arguments, const sim::WorldConfig& world) {
  sim::Scene scene =
      sim::build_scene(world, static_cast<std::uint64_t>(arguments.seed), harness::default_cache());
  if (arguments.rover.empty()) return scene;
  const auto rover = sim::load_rover(arguments.rover_file);
  sim::add_rover(scene, rover.model);
  return scene;
}

void check(const RenderArguments& arguments) {
  if (arguments.pose.empty()) fail("render: expected --pose X,Y,Z,YAW or --turntable");
  const bool flows = !arguments.flow.empty() || !arguments.flow_visible.empty();
  if (flows == arguments.flow_to.empty()) {
    fail("render: expected --flow FILE or --flow-visible FILE and --flow-to X,Y,Z,YAW together");
  }
  if (arguments.rover.empty() && !arguments.rover_to.empty()) {
    fail("render: expected --rover X,Y,Z,YAW with --rover-to");
  }
}

int render(const RenderArguments& arguments) {
  std::vector<Override> overrides;
  for (const std::string& text : arguments.overrides) overrides.push_back(parse_override(text));
  const sim::WorldConfig world = sim::load_world(arguments.world, overrides);
  const RigCamera camera = camera_of(arguments);
  if (arguments.turntable) {
    const auto seed = static_cast<std::uint64_t>(arguments.seed);
    harness::write_image(arguments.out,
                         harness::turntable(world, seed, camera.model, renderer_config()));
    return 0;
  }
  check(arguments);
  const Pose T_world_cam = harness::parse_view(arguments.pose) * camera.T_body_cam;
  const sim::Scene scene = scene_of(arguments, world);
  const auto renderer = sim::make_render_engine(scene, renderer_config());
  const TruthView view{camera.model, T_world_cam,
                       sim::render_with_glare(*renderer, scene.light, camera.model, T_world_cam,
                                              request_of(arguments))};
  write_images(arguments, view.image);
  write_warps(arguments, *renderer, view, camera);
  return 0;
}

void add_truth_options(CLI::App& command, RenderArguments& arguments) {
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

void add_rover_options(CLI::App& command, RenderArguments& arguments) {
  command.add_option("--rover", arguments.rover,
                     "X,Y,Z,YAW[,PITCH] in m and degrees: also show a rover that stands there");
  command.add_option("--rover-to", arguments.rover_to, "Where it stands in the view of --flow-to");
  command.add_option("--rover-file", arguments.rover_file, "Which rover (YAML)")
      ->capture_default_str();
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Make an image of a world");
  command->add_option("WORLD", arguments->world, "World file (YAML)")->required();
  command->add_option("--out", arguments->out, "RenderedImage to write, .png or .jpg")->required();
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
      ->add_option("--set", arguments->overrides,
                   "Set a key of the world, e.g. sun.elevation_deg=20; may stand many times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([&chosen, arguments] { chosen = [arguments] { return render(*arguments); }; });
}

}  // namespace vinebench::tools
