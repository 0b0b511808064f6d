// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"
#include "slam/patches/refinement_config.h"
#include "slam/stereo/stereo_matcher.h"

namespace vinebench::slam {

/// What following patches is set by.
struct FollowSettings {
  RefinementConfig refinement;
  StereoConfig stereo;
};

/// Follows landmarks that the corner detector did not find again: each is looked for by its patch
/// where a good pose says that it is, in both cameras. What is found is appended to the frame's
/// features and tied. From one frame to the next a detector finds only about a third of a plant's
/// corners again; followed, a landmark is seen for as long as it is in the image, which is what
/// keeps a pose from drifting (after SVO's feature alignment: Forster et al., 2014).
///
/// `landmarks` ascending; at most RefinementConfig::follow a view, spread over the image, those
/// seen by most keyframes first. Does nothing for a frame that has no pyramids.
void follow_patches(const Map& map, const std::vector<int>& landmarks, const Pose& T_map_body,
                    const EstimatorRig& rig, const FollowSettings& settings, FrameFeatures& frame,
                    Associations& associations);

}  // namespace vinebench::slam
