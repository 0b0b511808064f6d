// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/tag_factors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/geometry/step_covariance.h"
#include "slam/factors/reprojection.h"
#include "slam/tags/tag_sightings.h"

namespace vinebench::slam {
namespace {

/// 95 % of the chi-square distribution with six degrees of freedom.
constexpr double kSurveyLimit = 12.59;

/// A tag that fewer keyframes saw measures no way.
constexpr std::size_t kFewestSightings = 3;

}  // namespace

TagFactors::TagFactors(const TagCameras& cameras, double corner_sigma, bool tags_move)
    : cameras_(cameras),
      corner_sigma_(corner_sigma),
      tags_move_(tags_move),
      huber_(std::sqrt(kChiSquared2)),
      survey_huber_(std::sqrt(kSurveyLimit)) {}

void TagFactors::add_to(ProblemBuilder& problem, const Map& map) {
  for (const MapTag& tag : map.tags()) {
    blocks_.push_back(to_block(tag.T_map_tag));
    held_.push_back(!tags_move_ || map.is_held(tag));
  }
  used_.assign(blocks_.size() + 1, 0);
  blocks_.push_back(to_block(map.world().value_or(Pose{})));
  for (const int id : problem.window().moved) add_sightings(id, map, problem);
  for (const int id : problem.window().fixed) add_sightings(id, map, problem);
  if (tags_move_ && map.world()) add_surveys(map, problem);
}

void TagFactors::add_surveys(const Map& map, ProblemBuilder& problem) {
  double* world = blocks_.back().data();
  for (std::size_t t = 0; t < map.tags().size(); ++t) {
    const std::optional<SurveyedPlace>& survey = map.tags()[t].survey;
    if (!used_[t] || held_[t] || !survey) continue;
    if (!used_.back()) problem.add_pose(world, ProblemBuilder::Group::kTags);
    used_.back() = 1;
    surveys_.emplace_back(survey->T_world_tag, survey->covariance);
    problem.add_factor(surveys_.back(), &survey_huber_, {world, blocks_[t].data()});
  }
  const bool fixed = std::ranges::any_of(map.tags(), &MapTag::fixed);
  if (used_.back() && fixed) problem.hold(world);
}

double* TagFactors::block_of(std::size_t index, ProblemBuilder& problem) {
  double* block = blocks_[index].data();
  if (!used_[index]) {
    problem.add_pose(block, ProblemBuilder::Group::kTags);
    if (held_[index]) problem.hold(block);
    used_[index] = 1;
  }
  return block;
}

void TagFactors::add_sightings(int keyframe, const Map& map, ProblemBuilder& problem) {
  for (const TagSighting& sighting : map.keyframe(keyframe).frame->tags) {
    const MapTag* tag = map.find_tag(sighting.family, sighting.id);
    if (tag == nullptr || (!tags_move_ && !tag->sure)) continue;
    double* block = block_of(static_cast<std::size_t>(tag - map.tags().data()), problem);
    const std::array<Eigen::Vector3d, 4> corners = tag_corners(tag->size);
    const double sigma = corner_sigma(sighting, corner_sigma_);
    const auto camera = static_cast<std::size_t>(sighting.camera);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      factors_.emplace_back(cameras_.undistorted[camera], ideal_corner(sighting, c, cameras_),
                            sigma, corners[c]);
      problem.add_factor(factors_.back(), &huber_, {problem.pose_of(keyframe), block});
    }
  }
}

void TagFactors::write_back(Map& map) const {
  for (std::size_t t = 0; t + 1 < blocks_.size(); ++t) {
    if (!used_[t]) continue;
    if (!held_[t]) map.tags()[t].T_map_tag = from_block(blocks_[t].data());
    map.tags()[t].sure = true;
  }
  if (used_.back()) map.world() = from_block(blocks_.back().data());
}

TagMeasures::TagMeasures(const EstimatorRig& rig, const TagAccuracy& accuracy,
                         CalibrationUnknowns& calibration)
    : rig_(rig),
      accuracy_(accuracy),
      calibration_(calibration),
      huber_(std::sqrt(kChiSquared2)),
      camera_blocks_(rig.tag_cameras.cameras.size(), nullptr) {}

void TagMeasures::add_to(ProblemBuilder& problem, const Map& map) {
  std::map<std::pair<std::size_t, int>, Visit> visits;  // by tag of the map and camera
  const auto collect = [&](int id) {
    for (const TagSighting& sighting : map.keyframe(id).frame->tags) {
      const MapTag* tag = map.find_tag(sighting.family, sighting.id);
      if (tag == nullptr) continue;
      visits[{static_cast<std::size_t>(tag - map.tags().data()), sighting.camera}].emplace_back(
          id, &sighting);
    }
  };
  std::ranges::for_each(problem.window().moved, collect);
  std::ranges::for_each(problem.window().fixed, collect);
  std::erase_if(visits, [](const auto& v) { return v.second.size() < kFewestSightings; });
  if (visits.empty()) return;
  // Nothing moves any more once it is handed out.
  blocks_.reserve(7 + 7 * camera_blocks_.size() + (7 + TagErrors::kNumbers) * visits.size());
  origin_ = take_pose(Pose{});
  problem.add_pose(origin_, ProblemBuilder::Group::kTagMeasures);
  problem.hold(origin_);
  for (const auto& [seen, visit] : visits) {
    add_visit(map.tags()[seen.first], seen.second, visit, map, problem);
  }
}

void TagMeasures::add_visit(const MapTag& tag, int camera, const Visit& visit, const Map& map,
                            ProblemBuilder& problem) {
  double* mounting = camera_block(camera, problem);
  double* time = calibration_.tag_time(rig_.tag_camera(camera));
  double* place = take_pose(tag.T_map_tag);
  problem.add_pose(place, ProblemBuilder::Group::kTagMeasures);
  double* errors = blocks_.data() + blocks_.size();
  blocks_.resize(blocks_.size() + TagErrors::kNumbers, 0.0);
  problem.add_block(errors, TagErrors::kNumbers, ProblemBuilder::Group::kTagMeasures);
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(TagErrors::kNumbers, 1 / accuracy_.corners);
  weight[TagErrors::kSize] = 1 / accuracy_.size;
  priors_.emplace_back(weight.asDiagonal().toDenseMatrix(),
                       Eigen::VectorXd::Zero(TagErrors::kNumbers));
  problem.add_factor(priors_.back(), nullptr, {errors});
  const std::array<Eigen::Vector3d, 4> corners = tag_corners(tag.size);
  for (const auto& [keyframe, sighting] : visit) {
    const double sigma = corner_sigma(*sighting, accuracy_.corners);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      factors_.emplace_back(rig_.tag_cameras.undistorted[static_cast<std::size_t>(camera)],
                            ideal_corner(*sighting, c, rig_.tag_cameras), sigma, corners[c],
                            static_cast<int>(c), map.keyframe(keyframe).frame->velocity,
                            rig_.tag_time(camera));
      problem.add_factor(factors_.back(), &huber_,
                         {problem.pose_of(keyframe), place, mounting, time, errors});
    }
  }
}

double* TagMeasures::camera_block(int camera, ProblemBuilder& problem) {
  double*& block = camera_blocks_[static_cast<std::size_t>(camera)];
  if (block != nullptr) return block;
  const Pose& T_body_cam = rig_.tag_cameras.cameras[static_cast<std::size_t>(camera)].T_body_cam;
  block = take_pose(T_body_cam);
  problem.add_pose(block, ProblemBuilder::Group::kTagMeasures);
  mountings_.emplace_back(
      T_body_cam,
      isotropic_covariance(accuracy_.position, accuracy_.rotation_deg * std::numbers::pi / 180));
  problem.add_factor(mountings_.back(), nullptr, {origin_, block});
  return block;
}

double* TagMeasures::take_pose(const Pose& pose) {
  const PoseBlock numbers = to_block(pose);
  blocks_.insert(blocks_.end(), numbers.begin(), numbers.end());
  return blocks_.data() + blocks_.size() - numbers.size();
}

}  // namespace vinebench::slam
