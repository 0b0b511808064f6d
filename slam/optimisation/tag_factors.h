// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/normal_prior.h>

#include <deque>
#include <utility>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/camera/measurement_noise.h"
#include "slam/camera/tag_cameras.h"
#include "slam/factors/relative_pose_factor.h"
#include "slam/factors/tag_corner_factor.h"
#include "slam/factors/tag_measure_factor.h"
#include "slam/optimisation/calibration_unknowns.h"
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

/// Tags as measures of length where calibrations are unknown: the way past a tag, in lengths of its
/// sides, is that of the map only if the pairs' baselines are right. Of each tag that keyframes of
/// the window saw often enough the place is an unknown, and what its image may be off by each time
/// (TagErrors); so are the mountings of the cameras that saw it, beside their times, which belong
/// to the calibration. Surveys take no part.
class TagMeasures : public FactorSource {
 public:
  /// Rig and calibration must outlive it.
  TagMeasures(const EstimatorRig& rig, const TagAccuracy& accuracy,
              CalibrationUnknowns& calibration);

  void add_to(ProblemBuilder& problem, const Map& map) override;

 private:
  /// Sightings of one tag by one camera, with their keyframes.
  using Visit = std::vector<std::pair<int, const TagSighting*>>;
  void add_visit(const MapTag& tag, int camera, const Visit& visit, const Map& map,
                 ProblemBuilder& problem);
  double* camera_block(int camera, ProblemBuilder& problem);
  double* take_pose(const Pose& pose);

  const EstimatorRig& rig_;
  TagAccuracy accuracy_;
  CalibrationUnknowns& calibration_;
  ceres::HuberLoss huber_;
  std::vector<double> blocks_;          ///< of all unknowns, one behind the other
  std::vector<double*> camera_blocks_;  ///< by camera; null where it has none
  double* origin_ = nullptr;            ///< held: what mountings are measured from
  std::deque<TagMeasureFactor> factors_;
  std::deque<RelativePoseFactor> mountings_;
  std::deque<ceres::NormalPrior> priors_;
};

}  // namespace vinebench::slam
