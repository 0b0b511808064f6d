// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The SLAM core of "Multicamera Visual SLAM For Vineyard Inspection", Sect. III: tracking, local
/// mapping, tag detection and loop closing over a rig of any number of stereo pairs. It is given
/// frames, the rig and the poses of registered tags, and nothing else.

#include <memory>
#include <vector>

#include "slam/base/rig.h"
#include "slam/base/slam_system.h"
#include "slam/base/worker_pool.h"
#include "slam/config.h"

namespace vinebench {

/// The lockstep SLAM system: everything that a frame starts is finished before its estimate is
/// returned, and the result does not depend on the pool's number of threads. Throws Error for a rig
/// that it cannot use (no stereo pair, two eyes that look different ways, an unknown camera name).
std::unique_ptr<SlamSystem> make_slam(const SlamConfig& config, const Rig& rig,
                                      std::vector<RegisteredTag> tags, WorkerPool& pool);

}  // namespace vinebench
