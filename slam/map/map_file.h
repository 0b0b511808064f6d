// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

// A map as a file: little endian, IEEE 754.
//
//     8 bytes  "vinemap" and a zero
//     u32      version of the format
//     u64      bytes of content
//     …        content: rig, level scale, tags, landmarks, keyframes
//     u64      CRC-64/XZ of all before it
//
// Frames are numbered and stamped against the last keyframe, which has index -1000 and stamp -1 s,
// so that they lie before those of the run that loads them. What follows from the rest is left out
// (observations, covisibility, grids), as are landmarks that were removed: a map that is saved,
// loaded and saved again gives the same bytes.

/// The bytes of a map file.
std::string format_map(const Map& map, const EstimatorRig& rig);

/// Reads what format_map wrote. `where` names it in messages. Throws Error when it is no map, cut
/// off, altered, of a version it does not know, or made with another rig (pairs, lenses, baselines,
/// mounts or pyramid) than `rig`.
Map parse_map(std::string_view bytes, const EstimatorRig& rig, const std::string& where);

/// Writes a map file, whole or not at all. Throws Error with the system's reason.
void save_map(const Map& map, const EstimatorRig& rig, const std::filesystem::path& file);

/// Reads a map file. Throws Error as parse_map does, or when the file cannot be read.
Map load_map(const std::filesystem::path& file, const EstimatorRig& rig);

}  // namespace vinebench::slam
