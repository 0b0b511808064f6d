// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/tag_candidates.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "core/geometry/step_covariance.h"
#include "harness/experiment/clear_view.h"
#include "sim/rover/route.h"
#include "sim/world/world_layout.h"
#include "slam/optimisation/tag_localisation.h"
#include "slam/tags/tag_sightings.h"

namespace vinebench::harness {
namespace {

constexpr double kTurnSpacing = 20 * std::numbers::pi / 180;  // rad

bool far_from(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double spacing) {
  return (a - b).head<2>().norm() >= spacing || std::abs(a.z() - b.z()) >= kTurnSpacing;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the segments have a point in common.
bool cross_each_other(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                      const Eigen::Vector2d& d) {
  const double denominator = cross(b - a, d - c);
  if (denominator == 0) return false;
  const double along_ab = cross(c - a, d - c) / denominator;
  const double along_cd = cross(c - a, b - a) / denominator;
  return along_ab >= 0 && along_ab <= 1 && along_cd >= 0 && along_cd <= 1;
}

/// Whether a row's vines stand between the camera and what is before the tag.
bool hidden_by_rows(const std::vector<sim::RowConfig>& rows, const Eigen::Vector3d& camera,
                    const Eigen::Vector3d& tag, double clearance) {
  const Eigen::Vector2d from = camera.head<2>();
  const Eigen::Vector2d whole = tag.head<2>() - from;
  const double length = whole.norm();
  if (length <= clearance) return false;
  const Eigen::Vector2d to = from + whole * ((length - clearance) / length);
  return std::ranges::any_of(rows, [&](const sim::RowConfig& row) {
    return cross_each_other(from, to, row.start, row.end);
  });
}

TagSighting sighting_of(const WorldTag& tag, int camera, const Rig& rig, const Pose& T_world_body,
                        double corner_sigma) {
  const RigCamera& seen_by = rig.cameras[static_cast<std::size_t>(camera)];
  TagSighting sighting;
  sighting.camera = camera;
  sighting.family = tag.family;
  sighting.id = tag.id;
  sighting.corner_sigma = corner_sigma;
  sighting.T_cam_tag = (T_world_body * seen_by.T_body_cam).inverse() * tag.T_world_tag;
  for (std::size_t c = 0; c < 4; ++c) {
    sighting.corners[c] =
        seen_by.model.project(sighting.T_cam_tag * slam::tag_corners(tag.size)[c]);
  }
  return sighting;
}

/// With the tags' poses in the world.
std::vector<TagCandidate> placed(sim::WorldConfig world,
                                 const std::vector<sim::WorldConfig::Tag>& tags) {
  world.tags = tags;
  const std::vector<WorldTag> in_world = sim::world_tags(world);
  std::vector<TagCandidate> candidates;
  for (std::size_t i = 0; i < tags.size(); ++i) candidates.push_back({tags[i], in_world[i]});
  return candidates;
}

}  // namespace

std::vector<Pose> route_poses(const ScenarioConfig& scenario, double spacing) {
  const sim::Route route(scenario.simulation.route);
  const sim::WorldLayout layout = sim::lay_out(scenario.simulation.world);
  std::vector<Eigen::Vector3d> places{route.start()};
  const Stamp step = from_seconds(0.05);
  for (Stamp t = 0; t <= route.duration(); t += step) {
    const Eigen::Vector3d place = route.at(t).pose;
    if (far_from(place, places.back(), spacing)) places.push_back(place);
  }
  std::vector<Pose> poses;
  for (const Eigen::Vector3d& place : places) poses.push_back(standing_at(place, layout.terrain));
  return poses;
}

std::vector<TagCandidate> post_candidates(const sim::WorldConfig& world, double height,
                                          double size) {
  std::vector<sim::WorldConfig::Tag> tags;
  for (const sim::TrellisPost& post : sim::lay_out(world).posts) {
    for (const sim::WorldConfig::PostSide::Side side :
         {sim::WorldConfig::PostSide::Side::kLeft, sim::WorldConfig::PostSide::Side::kRight}) {
      sim::WorldConfig::Tag tag;
      tag.id = static_cast<int>(tags.size());
      tag.size = size;
      tag.post = sim::WorldConfig::PostSide{};
      tag.post->row = post.row;
      tag.post->index = post.index;
      tag.post->side = side;
      tag.post->height = height;
      tags.push_back(tag);
    }
  }
  return placed(world, tags);
}

std::vector<TagCandidate> own_tags(const sim::WorldConfig& world) {
  return placed(world, world.tags);
}

void predict_sightings(std::vector<TagCandidate>& candidates, const std::vector<Pose>& poses,
                       const Rig& rig, const sim::WorldConfig& world, const SightingModel& model) {
  const ClearView view(rig);
  const slam::TagCameras cameras(rig.cameras);
  const sim::WorldLayout layout = sim::lay_out(world);
  const Matrix6d survey = isotropic_covariance(model.survey.position, model.survey.rotation);
  for (TagCandidate& candidate : candidates) {
    const WorldTag& tag = candidate.placed;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      for (std::size_t c = 0; c < rig.tag_cameras.size(); ++c) {
        if (!view.sees(c, tag, poses[k])) continue;
        const int camera = rig.tag_cameras[c];
        const Pose T_world_cam =
            poses[k] * rig.cameras[static_cast<std::size_t>(camera)].T_body_cam;
        if (hidden_by_rows(layout.rows, T_world_cam.translation, tag.T_world_tag.translation,
                           model.vine_clearance)) {
          continue;
        }
        const TagSighting sighting = sighting_of(tag, camera, rig, poses[k], model.corner_sigma);
        const Matrix6d of_tag = slam::tag_covariance(sighting, tag.size, cameras, 0) + survey;
        const Pose T_tag_body = tag.T_world_tag.inverse() * poses[k];
        const Matrix6d of_body = carry_covariance(of_tag, T_tag_body);
        candidate.information.emplace_back(k, of_body.ldlt().solve(Matrix6d::Identity()));
      }
    }
  }
}

}  // namespace vinebench::harness
