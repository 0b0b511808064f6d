// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/files/cache_folder.h"
#include "core/frame.h"
#include "core/slam_system.h"
#include "core/truth/frame_source.h"
#include "core/util/stage_timer.h"
#include "core/util/worker_pool.h"
#include "sim/simulation_config.h"

namespace vinebench::sim {

class DrawnScene;

/// Drives the rover along its route and takes an image with every camera at each frame's instant.
/// rig() is the nominal rig; the images are taken with the true one, which differs by the
/// calibration error. Stamps may have errors; the truth is that of the frame's instant. A dropped
/// image is empty: nothing occludes it and no tag is visible. With `steering: estimate` the rover
/// is steered by the estimates: the first pose is aligned with the rover's true pose, and without a
/// pose the last command continues.
///
/// A frame that is not in the plan is simulated but not delivered; its readings are part of the
/// next one. Delivered images do not depend on the plan: with automatic exposure, the others are
/// rendered too.
///
/// `drawn` is used if it serves this simulation, else a scene of its own.
std::unique_ptr<SimulatedSource> make_simulation(
    const SimulationConfig& config, std::uint64_t seed, const CacheFolder& cache, WorkerPool& pool,
    const CapturePlan& plan = {}, const std::shared_ptr<DrawnScene>& drawn = nullptr);

}  // namespace vinebench::sim
