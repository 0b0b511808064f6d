// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/geometry/pose.h"

namespace vinebench::harness {

/// The landmarks that the SLAM core wrote (slam/map/point_cloud.h) for a page: x, y, z (cm, in the
/// world) and grey level, point after point; of more than 20,000, every n-th. Throws Error for a
/// file that is no such point cloud.
nlohmann::ordered_json landmarks_json(const std::filesystem::path& file, const Pose& T_world_map);

}  // namespace vinebench::harness
