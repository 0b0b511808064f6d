// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "sim/asset.h"
#include "sim/world.h"

namespace vinebench {

/// The plants of a world, one for each template: read from the folder `cache`, or grown from the
/// seed and kept there as .glb files. Their names hold a hash of all that shapes them; a file that
/// is damaged is grown anew. Throws Error when the folder cannot be written.
std::vector<Asset> cached_plants(const WorldConfig::Vines& vines, std::uint64_t seed,
                                 const std::filesystem::path& cache);

}  // namespace vinebench
