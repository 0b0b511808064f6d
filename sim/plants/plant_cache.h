// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/files/cache_folder.h"
#include "sim/assets/asset.h"
#include "sim/world/vines.h"

namespace vinebench::sim {

/// The plants of a world, one for each template.
struct PlantSet {
  std::vector<Asset> grown;
  std::vector<Asset> young;  ///< of the second year; empty if the world has none
};

/// Read from the cache, or generated from the seed and kept there as .glb files. Their names
/// contain a hash of all inputs; if one is missing or not as it was written, all are generated
/// again. Where they cannot be kept the cache's notice tells so, once. Throws Error if the
/// cultivar's file cannot be read.
PlantSet cached_plants(const VinesConfig& vines, std::uint64_t seed, const CacheFolder& cache);

}  // namespace vinebench::sim
