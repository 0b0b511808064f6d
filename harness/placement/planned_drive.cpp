// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/planned_drive.h"

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr double kPoseSpacing = 0.5;  // m

}  // namespace

PlannedDrive plan_drive(const std::filesystem::path& world, const std::filesystem::path& route,
                        const OdometryDrift& drift, const SurveyAccuracy& survey) {
  const std::string world_file = std::filesystem::absolute(world).string();
  ScenarioConfig scenario = load_scenario(route, {{"world", "\"" + world_file + "\""}});
  Rig rig = load_rig(scenario.simulation.rover.rig);
  if (rig.tag_cameras.empty()) fail("{}: the rover has no camera for tags", route.string());
  std::vector<Pose> poses = route_poses(scenario, kPoseSpacing);
  PoseChain chain(poses, drift);
  PlannedDrive planned{std::move(scenario), std::move(rig), std::move(poses), std::move(chain)};
  planned.sightings.survey = survey;
  return planned;
}

std::vector<TagCandidate> own_tags(const PlannedDrive& drive) {
  auto tags = own_tags(drive.world());
  predict_sightings(tags, drive.poses, drive.rig, drive.world(), drive.sightings);
  return tags;
}

std::vector<TagCandidate> post_candidates(const PlannedDrive& drive, double height, double size) {
  auto tags = post_candidates(drive.world(), height, size);
  if (tags.empty()) fail("{}: has no posts to hang tags on", drive.world().name);
  predict_sightings(tags, drive.poses, drive.rig, drive.world(), drive.sightings);
  return tags;
}

}  // namespace vinebench::harness
