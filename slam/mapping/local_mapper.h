// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"
#include "slam/mapping/mapping_config.h"
#include "slam/optimisation/bundle_adjustment.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// What LocalMapper is set by.
struct LocalMapperSettings {
  MappingConfig mapping;
  bool refinement = true;            ///< features are placed on their landmark's patch
  int max_hamming = 64;              ///< bits
  double second_best = 0.85;         ///< of new landmarks: see EpipolarSearch
  double min_depth = 0.15;           ///< m, likewise
  double far_depth_baselines = 150;  ///< see StereoConfig
  double tag_corner_sigma = 0.08;    ///< px, by which a tag's corner is off besides its noise
  std::optional<InertialNoise> inertial{};  ///< of a unit that takes part
};

/// Local mapping: what a new keyframe adds to the map.
class LocalMapper {
 public:
  explicit LocalMapper(const LocalMapperSettings& settings) : settings_(settings) {}

  /// Makes the frame a keyframe: its tracked landmarks are tied, its other features with a stereo
  /// match that is not too far away become landmarks. Returns its id.
  int insert(const TrackedFrame& tracked, const EstimatorRig& rig, Map& map) const;

  /// Drops landmarks that too few keyframes saw, finds new ones between the keyframe and its
  /// covisible ones, and fuses doubles.
  void extend(int keyframe, const EstimatorRig& rig, Map& map) const;

  /// Ties these landmarks to the features of the keyframe that are where they are to be, in place
  /// of other landmarks that it had for them.
  void tie(const std::vector<int>& landmarks, int keyframe, const EstimatorRig& rig,
           Map& map) const {
    fuse_into(landmarks, keyframe, rig, map);
  }

  AdjustmentOptions adjustment_options() const;

  /// The adjustment of the keyframe's neighbourhood, yet to be solved.
  std::unique_ptr<AdjustmentJob> local_adjustment(int keyframe, const Map& map,
                                                  const EstimatorRig& rig) const;

 private:
  void cull(int keyframe, Map& map) const;
  void fuse(int keyframe, const EstimatorRig& rig, Map& map) const;
  void fuse_into(const std::vector<int>& landmarks, int keyframe, const EstimatorRig& rig,
                 Map& map) const;
  void triangulate(int keyframe, const EstimatorRig& rig, Map& map) const;
  void triangulate_between(int newer, int older, int view, const EstimatorRig& rig, Map& map) const;

  LocalMapperSettings settings_;
};

}  // namespace vinebench::slam
