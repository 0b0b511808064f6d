// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_cache.h"

#include <algorithm>
#include <optional>

#include "core/config/yaml_writer.h"
#include "core/util/error.h"
#include "core/util/files.h"
#include "core/util/random.h"
#include "sim/assets/asset_file.h"
#include "sim/plants/grapevine.h"
#include "sim/plants/plant_textures.h"

namespace vinebench::sim {
namespace {

constexpr int kYoungTemplates = 2;

/// Of the generator's sources, the seed and what it is told.
std::string plant_name(const PlantBrief& brief, std::uint64_t seed, int index) {
  VinesConfig vines = brief.vines;
  vines.cultivar.clear();  // its content counts, not its name
  vines.meshes.clear();
  vines.mesh_import.reset();
  const std::string key = fmt::format("{} {}\n{}{}", VINEBENCH_PLANT_HASH, seed, format_yaml(vines),
                                      format_yaml(brief.cultivar));
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

std::vector<Grapevine> grow(PlantBrief brief, std::uint64_t seed, int count) {
  std::vector<Grapevine> plants;
  for (int i = 0; i < count; ++i) {
    brief.young = i >= brief.vines.templates;
    plants.push_back(grow_grapevine(brief, seed, brief.young ? i - brief.vines.templates : i));
  }
  return plants;
}

}  // namespace

PlantSet cached_plants(const VinesConfig& vines, std::uint64_t seed,
                       const std::filesystem::path& cache) {
  const PlantBrief brief{vines, load_cultivar(vines.cultivar), growth_stage(vines.bbch), false};
  make_folder(cache);
  const int count = vines.templates + (vines.young > 0 ? kYoungTemplates : 0);
  std::vector<std::optional<Asset>> plants;
  for (int i = 0; i < count; ++i)
    plants.push_back(cached_plant(cache / plant_name(brief, seed, i)));
  const bool whole =
      std::ranges::all_of(plants, [](const auto& plant) { return plant.has_value(); });
  if (!whole) {
    const auto textures = plant_textures(brief.cultivar, brief.stage, seed);
    const std::vector<Asset> assets = mesh_grapevines(grow(brief, seed, count), textures);
    for (int i = 0; i < count; ++i) {
      const std::filesystem::path file = cache / plant_name(brief, seed, i);
      write_file_atomically(file, to_glb(assets.at(static_cast<std::size_t>(i))));
      plants.at(static_cast<std::size_t>(i)) = load_asset(file);  // as all later runs will see it
    }
  }
  PlantSet set;
  for (int i = 0; i < count; ++i) {
    std::vector<Asset>& to = i < vines.templates ? set.grown : set.young;
    to.push_back(*std::move(plants.at(static_cast<std::size_t>(i))));
  }
  return set;
}

}  // namespace vinebench::sim
