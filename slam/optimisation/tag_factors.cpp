// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/tag_factors.h"

#include <algorithm>
#include <cmath>

#include "slam/factors/reprojection.h"
#include "slam/tags/tag_sightings.h"

namespace vinebench::slam {
namespace {

/// 95 % of the chi-square distribution with six degrees of freedom.
constexpr double kSurveyLimit = 12.59;

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
    if (tag == nullptr) continue;
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
    if (used_[t] && !held_[t]) map.tags()[t].T_map_tag = from_block(blocks_[t].data());
  }
  if (used_.back()) map.world() = from_block(blocks_.back().data());
}

}  // namespace vinebench::slam
