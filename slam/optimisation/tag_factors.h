// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "slam/camera/tag_cameras.h"
#include "slam/factors/tag_corner_factor.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Corners of the mapped tags that keyframes of the window saw. Tags of known pose are held, and
/// all of them where `tags_move` is false.
class TagFactors : public FactorSource {
 public:
  /// `corner_sigma`: px, by which a corner is off besides the noise that a sighting knows of. The
  /// cameras must outlive it.
  TagFactors(const TagCameras& cameras, double corner_sigma, bool tags_move);

  void add_to(ProblemBuilder& problem, const Map& map) override;
  void write_back(Map& map) const override;

 private:
  void add_sightings(int keyframe, const Map& map, ProblemBuilder& problem);
  double* block_of(const MapTag& tag, std::size_t index, ProblemBuilder& problem);

  const TagCameras& cameras_;
  double corner_sigma_;
  bool tags_move_;
  ceres::HuberLoss huber_;
  std::vector<PoseBlock> blocks_;  ///< of Map::tags
  std::vector<char> used_;
  std::deque<TagCornerFactor> factors_;
};

}  // namespace vinebench::slam
