// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/config.h"
#include "slam/map/map.h"
#include "slam/optimisation/bundle_adjustment.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// Local mapping: what a new keyframe adds to the map.
class LocalMapper {
 public:
  LocalMapper(const SlamConfig& config, const EstimatorRig& rig) : config_(config), rig_(rig) {}

  /// Makes the frame a keyframe: its tracked landmarks are tied, its other features with a stereo
  /// depth become landmarks. Returns its id.
  int insert(const TrackedFrame& tracked, Map& map) const;

  /// Drops landmarks that too few keyframes saw, finds new ones between the keyframe and its
  /// covisible ones, and fuses doubles.
  void extend(int keyframe, Map& map) const;

  AdjustmentOptions adjustment_options() const;

  /// The adjustment of the keyframe's neighbourhood, yet to be solved.
  std::unique_ptr<AdjustmentJob> local_adjustment(int keyframe, const Map& map) const;

 private:
  void cull(int keyframe, Map& map) const;
  void fuse(int keyframe, Map& map) const;
  void fuse_into(const std::vector<int>& landmarks, int keyframe, Map& map) const;
  void triangulate(int keyframe, Map& map) const;
  void triangulate_between(int newer, int older, int view, Map& map) const;

  SlamConfig config_;
  const EstimatorRig& rig_;
};

}  // namespace vinebench::slam
