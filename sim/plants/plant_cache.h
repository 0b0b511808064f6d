// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "sim/assets/asset.h"
#include "sim/world/vines.h"

namespace vinebench::sim {

/// The plants of a world, one for each template.
struct PlantSet {
  std::vector<Asset> grown;
  std::vector<Asset> young;  ///< of the second year; empty if the world has none
};

/// Read from the folder `cache`, or generated from the seed and stored there as .glb files. Their
/// names contain a hash of all inputs; if one is missing or damaged all are generated again. Throws
/// Error if the folder cannot be written or the cultivar's file cannot be read.
PlantSet cached_plants(const VinesConfig& vines, std::uint64_t seed,
                       const std::filesystem::path& cache);

}  // namespace vinebench::sim
