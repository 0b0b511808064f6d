// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"
#include "slam/patches/refinement_config.h"

namespace vinebench::slam {

/// Places a frame's matched features to a fraction of a pixel: the corner detector finds whole
/// pixels of a pyramid level, and not the same ones from every distance. Each match is moved to
/// where the landmark's patch, as a keyframe saw it, fits best; a feature's stereo partner moves
/// with it. Matches without a patch to compare with stay where they are, and count as less certain;
/// those whose patch fits nowhere near are untied.
/// Does nothing for a frame that has no pyramids, and where refinement is switched off.
void refine_matches(const Map& map, const Pose& T_map_body, const EstimatorRig& rig,
                    const RefinementConfig& config, FrameFeatures& frame,
                    Associations& associations);

/// Cuts the patches of a keyframe's features that have a landmark and are placed to a fraction of a
/// pixel, or begin a landmark. None for a frame that has no pyramids.
std::vector<PatchList> cut_patches(const FrameFeatures& frame, const Associations& landmarks,
                                   const MeasurementNoise& noise);

}  // namespace vinebench::slam
