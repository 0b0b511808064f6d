// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The SLAM core of "Multicamera Visual SLAM For Vineyard Inspection", Sect. III: tracking, local
/// mapping, tag detection and loop closing over a rig of any number of stereo pairs. It is given
/// frames, the rig and the poses of registered tags, and nothing else.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/trajectory.h"
#include "core/util/error.h"
#include "core/util/worker_pool.h"
#include "slam/config.h"

namespace vinebench::slam {

/// A SLAM system whose map outlives it.
class MappingSystem : public SlamSystem {
 public:
  /// Goes on with a map that save_map wrote, once a frame has found its place in it, by a tag or by
  /// its looks; until then the status is kInitializing. Call before the first frame. Throws Error
  /// when the file is no map, damaged, or of another rig.
  virtual void load_map(const std::filesystem::path& file) = 0;

  /// Writes the map as it is now. Throws Error with the system's reason.
  virtual void save_map(const std::filesystem::path& file) const = 0;

  /// Writes the landmarks as a point cloud in PLY format. Throws Error with the system's reason.
  virtual void save_cloud(const std::filesystem::path& file) const = 0;

  /// Those of the last frame; none where the cameras did not support its pose.
  virtual std::vector<SupportingFeature> supporting_features() const = 0;
};

/// The lockstep SLAM system: everything that a frame starts is finished before its estimate is
/// returned, and the result does not depend on the pool's number of threads. With a pool of one
/// thread it starts no other, so that its process can be forked between two frames. Throws Error
/// for a rig that it cannot use (no stereo pair, two cameras that look different ways, an unknown
/// camera name).
std::unique_ptr<MappingSystem> make_slam(const SlamConfig& config, const Rig& rig,
                                         std::vector<RegisteredTag> tags, WorkerPool& pool);

}  // namespace vinebench::slam
