// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/truth/frame_source.h"
#include "core/util/stage_timer.h"
#include "core/util/worker_pool.h"
#include "sim/render/renderer.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"
#include "sim/sensors/sensors.h"
#include "sim/world/world.h"

namespace vinebench::sim {

struct SimulationConfig {
  WorldConfig world;
  RoverConfig rover;
  RouteConfig route;
  RendererConfig renderer;
  SensorsConfig sensors;
  std::optional<double> duration;  ///< s; the whole route where absent
  template <class Archive>
  void serialize(Archive& archive) {
    archive("world", world);
    archive("rover", rover);
    archive("route", route);
    archive("renderer", renderer);
    archive("sensors", sensors);
    archive("duration", duration, Range::positive());
  }
};

/// Drives the rover along its route and takes an image with every camera at each frame's instant.
/// rig() is what a SLAM system is told; the images are taken by the true one, which differs by
/// the calibration error. Stamps are what the cameras say; the truth is that of the frame's
/// instant. An image that is dropped is empty and shows nothing: its box share is 0 and no tag is
/// visible. Where the route says so the rover is steered by the estimates that it is answered:
/// the first one of a pose is taken to be where the rover stands, and while there is none it goes
/// on as commanded.
///
/// A frame that the plan leaves out is driven through and not delivered; its readings come with the
/// next one. No image that is delivered depends on the plan: where exposure is automatic, the
/// others are taken too.
std::unique_ptr<SimulatedSource> make_simulation(const SimulationConfig& config, std::uint64_t seed,
                                                 const std::filesystem::path& cache,
                                                 WorkerPool& pool, const CapturePlan& plan = {});

}  // namespace vinebench::sim
