// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/loop/places_config.h"
#include "slam/map/map.h"
#include "slam/tracking/relocaliser.h"

namespace vinebench::slam {

/// A keyframe that was taken where an earlier one was, or facing what that one faced.
struct PlaceReturn {
  int earlier = 0;                         ///< keyframe, the one that faces the same from nearest
  Pose T_map_body;                         ///< of the later one, by what the earlier ones mapped
  Matrix6d covariance = Matrix6d::Zero();  ///< of the pose against these, in the step of step_of
  Matrix6d earlier_covariance = Matrix6d::Zero();  ///< of the earlier one's pose, as it was told
  std::vector<int> landmarks;  ///< that the earlier ones mapped there, ascending
  bool tied = false;           ///< tracking has found these itself
};

/// Returns to places by their looks alone, whichever pair of cameras saw either: among the
/// keyframes that the body may be beside, within the drift of the way since, one is sought whose
/// landmarks the new one sees (`relocate_among`). Believed where every pair of cameras bears it out
/// (`bears_out`), where no other place within the drift is nearly as good, and two keyframes in a
/// row agree.
class PlaceLoops {
 public:
  explicit PlaceLoops(const PlacesConfig& config) : config_(config) {}

  /// Looks for a return of `keyframe`, the map's last, whose pose has that covariance. Call it for
  /// each keyframe once.
  std::optional<PlaceReturn> look(int keyframe, double path_length, const Matrix6d& covariance,
                                  const Map& map, const EstimatorRig& rig);

 private:
  /// A keyframe as it was told.
  struct Told {
    int keyframe = 0;
    double path_length = 0;  ///< m
    Matrix6d covariance = Matrix6d::Zero();
  };
  struct Candidate {
    int keyframe = 0;
    Pose T_map_body;  ///< as found
  };

  std::vector<const Told*> beside(int keyframe, const Map& map, const EstimatorRig& rig) const;
  std::optional<PlaceReturn> known(int keyframe, const std::vector<const Told*>& places,
                                   const Map& map) const;
  std::optional<PlaceReturn> find(int keyframe, const std::vector<const Told*>& places,
                                  const Map& map, const EstimatorRig& rig) const;
  bool within_drift(const Pose& T_map_body, int keyframe, const Told& place, const Map& map) const;
  bool agrees(const Candidate& before, const Map& map) const;

  PlacesConfig config_;
  std::vector<Told> told_;           ///< in the order of the way
  double known_until_ = 0;           ///< m, the way driven when a known place was seen last
  std::optional<Candidate> before_;  ///< of the keyframe before
};

}  // namespace vinebench::slam
