// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/pose.h"
#include "sim/world/occluders/occluder.h"
#include "sim/world/terrain.h"

namespace vinebench::sim {

/// The occluder's frame in the world. A crate leans with the ground; a person stands upright on it;
/// all else is upright and stands as low as the ground below its lowest corner, so that none hangs.
/// One with a path is where the path begins.
Pose occluder_pose(const Occluder& occluder, const Terrain& terrain);

/// The pose of an occluder with a path as a function of time.
class OccluderMotion {
 public:
  /// The occluder must have a path.
  OccluderMotion(const Occluder& occluder, const Terrain& terrain);
  Pose at(Stamp stamp) const;

 private:
  Occluder occluder_;
  Terrain terrain_;
  PathMotion motion_;
};

}  // namespace vinebench::sim
