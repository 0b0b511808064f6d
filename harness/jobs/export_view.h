// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry/pose.h"
#include "sim/render/view_export.h"

namespace vinebench::harness {

/// Writes a view for another renderer (tools/cycles/render.py): scene.glb, the sky all round as
/// sky.hdr, and camera.json with camera, pose, exposure and light. `T_world_rover` is where the
/// scene's rover stands, if it is to be seen.
void export_view(const std::filesystem::path& folder, sim::Scene scene,
                 const sim::ExportedView& view, double exposure,
                 const std::optional<Pose>& T_world_rover);

/// The sky's linear light, CV_32FC3 RGB: longitude in columns, from that of -x over +y to the left
/// round to -x again, and latitude in rows, the zenith first.
cv::Mat sky_panorama(const sim::Light& light, std::uint64_t seed, cv::Size size);

/// What even light from all above would be as bright on level ground: the mean of the upper half,
/// each direction by its share of a level surface's light; of green.
double light_from_above(const cv::Mat& panorama);

}  // namespace vinebench::harness
