// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/camera/tag_cameras.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// Takes the images of a camera for tags to be taken that many seconds later than was thought: its
/// sightings in the map's keyframes are brought to their frames' stamps anew (bring_to_stamp).
/// Their frames become others; who has one keeps it as it was.
void take_tags_later(int camera, double seconds, const TagCameras& cameras, Map& map);

}  // namespace vinebench::slam
