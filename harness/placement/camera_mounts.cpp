// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/camera_mounts.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <tuple>

#include "core/util/error.h"
#include "core/util/suggestion.h"
#include "harness/placement/tag_plan.h"

namespace vinebench::harness {
namespace {

constexpr double kLowest = 0.1;  // m above the ground

RigConfig::Camera& camera_of(RigConfig& rig, const std::string& name) {
  const auto found = std::ranges::find(rig.cameras, name, &RigConfig::Camera::name);
  if (found != rig.cameras.end()) return *found;
  std::vector<std::string> names;
  for (const RigConfig::Camera& camera : rig.cameras) names.push_back(camera.name);
  fail("the rig has no camera '{}'{}", name, did_you_mean(name, names));
}

}  // namespace

CameraMount current_mount(const RigConfig& rig, const std::string& camera) {
  RigConfig copy = rig;
  const RigConfig::Camera& config = camera_of(copy, camera);
  return {config.position, config.rpy_deg};
}

void rate_mount(CameraMount& mount, const std::string& camera, const PlannedDrive& drive) {
  Rig rig = drive.rig;
  RigCamera& mounted = rig.cameras.at(static_cast<std::size_t>(rig.find_camera(camera)));
  mounted.T_body_cam = Rig::mount(mount.position, mount.rpy_deg * (std::numbers::pi / 180));
  std::vector<TagCandidate> tags = own_tags(drive.world());
  predict_sightings(tags, drive.poses, rig, drive.world(), drive.sightings);
  std::set<std::size_t> poses;
  mount.tags = 0;
  for (const TagCandidate& tag : tags) {
    mount.tags += !tag.information.empty();
    for (const auto& sighting : tag.information) poses.insert(sighting.first);
  }
  mount.poses = poses.size();
  mount.error = predict_tags(drive.chain, tags).error;
}

std::vector<CameraMount> rate_mounts(const CameraMount& current, const std::string& camera,
                                     const PlannedDrive& drive, const MountGrid& grid) {
  std::vector<CameraMount> mounts;
  for (const double raise : grid.raises) {
    for (const double pitch : grid.pitches_deg) {
      for (double yaw = -180; yaw < 180; yaw += grid.yaw_step_deg) {
        CameraMount mount{current.position, {current.rpy_deg.x(), pitch, yaw}};
        mount.position.z() += raise;
        if (mount.position.z() < kLowest) continue;
        rate_mount(mount, camera, drive);
        mounts.push_back(mount);
      }
    }
  }
  std::ranges::stable_sort(mounts, {}, [](const CameraMount& mount) {
    return std::tuple(mount.error, -static_cast<double>(mount.poses));
  });
  return mounts;
}

RigConfig with_mount(RigConfig rig, const std::string& camera, const CameraMount& mount) {
  RigConfig::Camera& config = camera_of(rig, camera);
  config.position = mount.position;
  config.rpy_deg = mount.rpy_deg;
  return rig;
}

std::string mounts_csv(const std::vector<CameraMount>& mounts) {
  std::string text = "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg,tags,poses,error_mm\n";
  for (const CameraMount& mount : mounts) {
    text +=
        fmt::format("{:g},{:g},{:g},{:g},{:g},{:g},{},{},{:.2f}\n", mount.position.x(),
                    mount.position.y(), mount.position.z(), mount.rpy_deg.x(), mount.rpy_deg.y(),
                    mount.rpy_deg.z(), mount.tags, mount.poses, 1e3 * mount.error);
  }
  return text;
}

}  // namespace vinebench::harness
