// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// How a landmark's patch, cut out of a keyframe's image, appears from another pose of the body.
struct PatchView {
  int level = 0;       ///< of the pyramid
  PatchWindow window;  ///< of that level's image
};

/// Predicts patches as one pose sees them: the homography of the landmark's plane, whose slant
/// stereo told where the patch was cut.
class PatchProjector {
 public:
  /// `T_map_bodies`: of each view, when it was taken.
  PatchProjector(const Map& map, std::vector<Pose> T_map_bodies, const EstimatorRig& rig);

  /// On that level of view `v`. None where the observation has no patch, is of another view, or is
  /// so much nearer, farther or turned that it would be another image.
  std::optional<PatchView> on_level(const Observation& seen, int v, const Landmark& landmark,
                                    int level);

  /// On the level where its pixels come out nearest to the patch's own.
  std::optional<PatchView> on_best_level(const Observation& seen, int v, const Landmark& landmark);

 private:
  /// From a keyframe's left camera to the same camera now: pixels of a plane at inverse depth rho,
  /// x_now ~ (turn + shift rho^T) x_then.
  struct Step {
    Eigen::Matrix3d turn;
    Eigen::Vector3d shift;
    Pose T_then_map;
  };

  const Patch* find_patch(const Observation& seen) const;
  const Step& step(int keyframe, int v);
  std::optional<Eigen::Matrix3d> homography(const Observation& seen, int v,
                                            const Landmark& landmark);
  std::optional<PatchView> view_on(const Eigen::Matrix3d& H, const Patch& patch, int level) const;

  const Map& map_;
  std::vector<Pose> T_map_bodies_;  ///< of each view
  const EstimatorRig& rig_;
  std::vector<std::vector<std::optional<Step>>> steps_;  ///< of each view, by keyframe
};

}  // namespace vinebench::slam
