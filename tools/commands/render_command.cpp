// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "harness/jobs/render_view.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

using harness::ViewRequest;

Option file(const char* name, std::string& target, const char* help) {
  return {.name = name, .target = &target, .help = help, .type = "FILE"};
}

std::vector<Option> view_options(ViewRequest& request, std::vector<std::string>& overrides) {
  return {{.name = "WORLD",
           .target = &request.world,
           .help = "World file (YAML), or the name of a world",
           .required = true,
           .data = harness::DataKind::kWorld},
          {.name = "--out",
           .target = &request.out,
           .help = "Image to write, .png or .jpg",
           .type = "FILE",
           .required = true},
          {.name = "--pose",
           .target = &request.pose,
           .help = "X,Y,Z,YAW[,PITCH] in m and degrees: the camera's place and view, or with --rig "
                   "the rover's"},
          {.name = "--camera",
           .target = &request.camera,
           .help = "WIDTHxHEIGHT@FOCAL in pixels (default: 752x480@263.2786), or with --rig the "
                   "name of its camera"},
          {.name = "--rig",
           .target = &request.rig,
           .help = "Rig whose camera to use",
           .data = harness::DataKind::kRig},
          {.name = "--turntable",
           .target = &request.turntable,
           .help = "Eight views from all round on one sheet"},
          {.name = "--seed",
           .target = &request.seed,
           .help = "Seed of plants, ground and sky",
           .show_default = true,
           .range = Range::non_negative()},
          overrides_option(overrides, "Set a key of the world, e.g. sun.elevation_deg=20")};
}

std::vector<Option> truth_options(ViewRequest& request) {
  return {file("--labels", request.labels, "Also write what each pixel shows, in colours"),
          file("--depth", request.depth, "Also write the depth, 16-bit PNG in mm"),
          file("--instances", request.instances,
               "Also write which plant, bunch or thing each pixel shows, in colours"),
          file("--normals", request.normals,
               "Also write the surfaces' normals (red right, green up, blue to the camera)"),
          file("--flow", request.flow,
               "Also write the optical flow to the view of --flow-to: .flo, or .png in colours"),
          {.name = "--flow-to", .target = &request.flow_to, .help = "X,Y,Z,YAW[,PITCH], as --pose"},
          file("--flow-visible", request.flow_visible,
               "Also write where that view still shows what a pixel shows, in white"),
          file("--disparity", request.disparity,
               "Also write the disparity to a right camera, 16-bit PNG in 1/256 px"),
          {.name = "--baseline",
           .target = &request.baseline,
           .help = "m from the camera to that right camera",
           .show_default = true,
           .range = Range::positive()}};
}

std::vector<Option> rover_options(ViewRequest& request) {
  return {{.name = "--rover",
           .target = &request.rover,
           .help = "X,Y,Z,YAW[,PITCH] in m and degrees: also show a rover that stands there"},
          {.name = "--rover-to",
           .target = &request.rover_to,
           .help = "Where it stands in the view of --flow-to"},
          {.name = "--rover-file",
           .target = &request.rover_file,
           .help = "Which rover (default: csl-rover)",
           .data = harness::DataKind::kRover}};
}

struct RenderArguments {
  ViewRequest request;
  std::vector<std::string> overrides;
  std::string quality = "fast";
  std::filesystem::path cache;
};

int render(const RenderArguments& arguments, const Surroundings& surroundings) {
  ViewRequest request = arguments.request;
  request.overrides = parse_overrides(arguments.overrides);
  choose(request.quality, arguments.quality);
  request.machine = with_cache(surroundings.machine, arguments.cache);
  if (!request.rover.empty() && request.rover_file.empty()) {
    request.rover_file =
        surroundings.catalogue.find(harness::DataKind::kRover, "csl-rover").string();
  }
  harness::render_view(request);
  return 0;
}

}  // namespace

Command render_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<RenderArguments>();
  Command command{.name = "render",
                  .description = "Make an image of a world",
                  .options = view_options(arguments->request, arguments->overrides),
                  .run = [arguments, surroundings] { return render(*arguments, surroundings); }};
  append(command.options, truth_options(arguments->request));
  append(command.options, rover_options(arguments->request));
  command.options.push_back({.name = "--export",
                             .target = &arguments->request.export_to,
                             .help = "Also write the view for another renderer: scene.glb, "
                                     "sky.hdr and camera.json",
                             .type = "FOLDER"});
  command.options.push_back({.name = "--quality",
                             .target = &arguments->quality,
                             .help = "fine: the finest plants near, and four samples a pixel",
                             .show_default = true,
                             .choices = yaml_names(sim::RenderQuality{})});
  command.options.push_back(cache_option(arguments->cache));
  return command;
}

}  // namespace vinebench::tools
