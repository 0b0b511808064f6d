// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/placement/camera_mounts.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

constexpr std::size_t kShownMounts = 5;

struct PlaceCameraArguments {
  std::string world;
  std::string route;
  std::string camera;
  harness::MountGrid grid;
  std::string out = "out/camera";
};

void tell(const char* what, const harness::CameraMount& mount) {
  fmt::print(
      "{:<8} position [{:g}, {:g}, {:g}], rpy_deg [{:g}, {:g}, {:g}]: {} tags, from {} poses; "
      "95 % of the poses within {:.1f} mm\n",
      what, mount.position.x(), mount.position.y(), mount.position.z(), mount.rpy_deg.x(),
      mount.rpy_deg.y(), mount.rpy_deg.z(), mount.tags, mount.poses, 1e3 * mount.error);
}

int place_camera(const PlaceCameraArguments& arguments) {
  const harness::PlannedDrive drive = harness::plan_drive(arguments.world, arguments.route, {}, {});
  if (drive.world().tags.empty()) fail("{}: has no tags to see", arguments.world);
  const auto rig = YamlDocument::load(drive.scenario.simulation.rover.rig).read<RigConfig>();
  const std::string camera = arguments.camera.empty() ? rig.tag_cameras.front() : arguments.camera;
  harness::CameraMount current = harness::current_mount(rig, camera);
  if (std::ranges::find(rig.tag_cameras, camera) == rig.tag_cameras.end()) {
    fail("camera '{}' does not search for tags", camera);
  }
  const FolderLock lock(arguments.out);
  harness::rate_mount(current, camera, drive);
  const auto mounts = harness::rate_mounts(current, camera, drive, arguments.grid);
  fmt::print("{} poses over the route, {} tags, {} mountings of '{}'\n", drive.poses.size(),
             drive.world().tags.size(), mounts.size(), camera);
  tell("as it is", current);
  for (std::size_t i = 0; i < std::min(kShownMounts, mounts.size()); ++i) {
    tell(fmt::format("{}", i + 1).c_str(), mounts[i]);
  }
  tell("most", *std::ranges::max_element(mounts, {}, [](const harness::CameraMount& mount) {
         return std::pair(mount.tags, mount.poses);
       }));
  const std::filesystem::path out = arguments.out;
  write_file_atomically(out / "rig.yaml",
                        format_yaml(harness::with_mount(rig, camera, mounts.front())));
  write_file_atomically(out / "mounts.csv", harness::mounts_csv(mounts));
  fmt::print("rig.yaml with the first one and mounts.csv are in {}\n",
             std::filesystem::absolute(out).string());
  return 0;
}

}  // namespace

Command place_camera_command() {
  const auto arguments = std::make_shared<PlaceCameraArguments>();
  std::vector<Option> options = drive_options(arguments->world, arguments->route);
  append(options, {{.name = "--camera",
                    .target = &arguments->camera,
                    .help = "Name of a camera for tags (default: the rig's first)"},
                   {.name = "--yaw-step",
                    .target = &arguments->grid.yaw_step_deg,
                    .help = "degrees between the directions that are tried",
                    .show_default = true,
                    .range = Range::between(1, 90)},
                   {.name = "--out",
                    .target = &arguments->out,
                    .help = "Folder for rig.yaml and mounts.csv",
                    .type = "FOLDER",
                    .show_default = true}});
  return {.name = "place-camera",
          .description = "Find the mounting of a camera that sees most of a vineyard's tags",
          .options = options,
          .run = [arguments] { return place_camera(*arguments); }};
}

}  // namespace vinebench::tools
