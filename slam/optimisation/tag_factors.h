// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "slam/camera/tag_cameras.h"
#include "slam/factors/relative_pose_factor.h"
#include "slam/factors/tag_corner_factor.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Corners of the mapped tags that keyframes of the window saw. Tags that hold the map stay, and
/// all of them where `tags_move` is false. The others are unknowns, with their surveys as
/// measurements of where they are in the world, whose place in the map is one more unknown unless a
/// fixed tag says it.
class TagFactors : public FactorSource {
 public:
  /// `corner_sigma`: px, by which a corner is off besides the noise that a sighting knows of. The
  /// cameras must outlive it.
  TagFactors(const TagCameras& cameras, double corner_sigma, bool tags_move);

  void add_to(ProblemBuilder& problem, const Map& map) override;
  void write_back(Map& map) const override;

 private:
  void add_sightings(int keyframe, const Map& map, ProblemBuilder& problem);
  double* block_of(std::size_t index, ProblemBuilder& problem);
  void add_surveys(const Map& map, ProblemBuilder& problem);

  const TagCameras& cameras_;
  double corner_sigma_;
  bool tags_move_;
  ceres::HuberLoss huber_;
  ceres::HuberLoss survey_huber_;
  std::vector<PoseBlock> blocks_;  ///< of Map::tags, and last of the world
  std::vector<char> used_;
  std::vector<char> held_;
  std::deque<TagCornerFactor> factors_;
  std::deque<RelativePoseFactor> surveys_;
};

}  // namespace vinebench::slam
