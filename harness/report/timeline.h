// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/truth/site.h"
#include "harness/run/run_record.h"

namespace vinebench::harness {

/// In a run's folder.
inline constexpr const char* kTimelineFile = "timeline.csv";
inline constexpr const char* kSiteFile = "site.json";

/// Name of a status in files: "tracked", "dead_reckoning", "initialising", "lost".
const char* status_name(TrackingStatus status);

/// A line a frame: `t` (s), `frame`, `status`, `keyframe` (0 or 1), the covariance of the live
/// position in the map's axes (`xx`, `xy`, `xz`, `yy`, `yz`, `zz`, m^2), and of each camera
/// `features:NAME`, `inliers:NAME` and `occluded:NAME` (share of its image that occluders cover, 0
/// to 1); `nan` where something is unknown, as where there is no pose.
std::string format_timeline(const RunRecord& record);

/// What stands in the vineyard, and the rig's cameras, for drawing a run: m, degrees; rotations as
/// quaternions x, y, z, w.
nlohmann::ordered_json site_json(const Site& site, const Rig& rig);

}  // namespace vinebench::harness
