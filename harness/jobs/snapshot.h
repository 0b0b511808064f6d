// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/camera.h"
#include "harness/experiment/scenario.h"
#include "sim/render/render_engine.h"
#include "sim/render/renderer_config.h"
#include "sim/scene/scene.h"
#include "sim/world/world.h"

namespace vinebench::harness {

/// Reads "WIDTHxHEIGHT@FOCAL" (px), such as 1920x1080@733, the principal point in the middle.
/// Throws Error for anything else.
PinholeCamera parse_camera(const std::string& text);

/// Reads "X,Y,Z,YAW" or "X,Y,Z,YAW,PITCH" (m and degrees; pitch is positive upwards) as the pose of
/// a frame with x forward, y left, z up. Throws Error for anything else.
Pose parse_view(const std::string& text);

/// Labels (CV_8UC1 of Label) in colours for the camera, CV_8UC3.
cv::Mat colour_labels(const cv::Mat& labels);

/// The exposure at which that view has the brightness that cameras steer to (sim/sensors).
double metered_exposure(sim::RenderEngine& renderer, const sim::Light& light,
                        const PinholeCamera& camera, const Pose& T_world_cam,
                        const std::optional<Pose>& T_world_rover);

/// A contact sheet of eight views of a world from all sides, from above eye level.
cv::Mat turntable(const sim::WorldConfig& world, std::uint64_t seed, const PinholeCamera& camera,
                  const sim::RendererConfig& renderer, const CacheFolder& plant_cache);

}  // namespace vinebench::harness
