// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plant_cache.h"

#include <optional>

#include "sim/asset_file.h"
#include "sim/grapevine.h"
#include "slam/base/error.h"
#include "slam/base/files.h"
#include "slam/base/random.h"

namespace vinebench {
namespace {

/// Of the generator's sources, the seed and what it is told.
std::string plant_name(const WorldConfig::Vines& vines, std::uint64_t seed, int index) {
  const std::string key =
      fmt::format("{} {} {} {} {} {}", VINEBENCH_PLANT_HASH, seed, vines.spacing,
                  vines.lowest_bunch, vines.canopy_top, vines.canopy_depth);
  return fmt::format("vine-{:016x}-{}.glb", fnv1a(key), index);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error)) {
    fail("{}: the cache of plants cannot be made: {}", folder.string(),
         error ? error.message() : "it is no folder");
  }
}

std::optional<Asset> cached_plant(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  try {
    return load_asset(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<Asset> cached_plants(const WorldConfig::Vines& vines, std::uint64_t seed,
                                 const std::filesystem::path& cache) {
  make_folder(cache);
  std::vector<Texture> textures;
  std::vector<Asset> plants;
  for (int i = 0; i < vines.templates; ++i) {
    const std::filesystem::path file = cache / plant_name(vines, seed, i);
    std::optional<Asset> plant = cached_plant(file);
    if (!plant) {
      if (textures.empty()) textures = plant_textures(seed);
      write_file_atomically(file, to_glb(mesh_grapevine(grow_grapevine(vines, seed, i), textures)));
      plant = load_asset(file);  // the first run sees what all later ones will
    }
    plants.push_back(*std::move(plant));
  }
  return plants;
}

}  // namespace vinebench
