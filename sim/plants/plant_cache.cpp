// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_cache.h"

#include <optional>
#include <string>
#include <utility>

#include "core/config/yaml_writer.h"
#include "core/util/arithmetic.h"
#include "core/util/error.h"
#include "core/util/random.h"
#include "sim/assets/asset_file.h"
#include "sim/plants/grapevine.h"
#include "sim/plants/plant_textures.h"

namespace vinebench::sim {
namespace {

constexpr int kYoungTemplates = 2;

/// Of the generator's sources, the seed, what it is told, and what computes: another libm or code
/// of OpenCV makes other bytes.
std::string plant_name(const PlantBrief& brief, std::uint64_t seed, int index) {
  VinesConfig vines = brief.vines;
  vines.cultivar.clear();  // its content counts, not its name
  vines.meshes.clear();
  vines.mesh_import.reset();
  const std::string key =
      fmt::format("{} {}\n{}\n{}{}", VINEBENCH_PLANT_HASH, seed, arithmetic_text(),
                  format_yaml(vines), format_yaml(brief.cultivar));
  return fmt::format("vine-{:016x}-{}.glb", fnv1a(key), index);
}

std::optional<Asset> cached_plant(const CacheFolder& cache, const std::string& name,
                                  DecodedImages& images) {
  const std::optional<std::string> bytes = read_cached(cache, name);
  if (!bytes) return std::nullopt;
  try {
    return asset_of_glb(*bytes, name, images);
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

/// The files of all plants of a set, as their bytes.
std::vector<std::string> generate(const PlantBrief& brief, std::uint64_t seed, int count) {
  const auto textures = plant_textures(brief.cultivar, brief.stage, seed);
  std::vector<std::string> files;
  for (const Asset& plant : mesh_grapevines(grow(brief, seed, count), textures)) {
    files.push_back(to_glb(plant));
  }
  return files;
}

/// A cache saves time alone: without one the plants are generated each time.
void keep(const CacheFolder& cache, const std::vector<std::string>& names,
          const std::vector<std::string>& files) {
  try {
    for (std::size_t i = 0; i < files.size(); ++i) write_cached(cache, names[i], files[i]);
  } catch (const Error& error) {
    if (!cache.notice) return;
    cache.notice(fmt::format("generated plants are not kept: {}", error.what()));
  }
}

std::vector<Asset> load_or_generate(const PlantBrief& brief, std::uint64_t seed, int count,
                                    const CacheFolder& cache) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(plant_name(brief, seed, i));
  std::vector<Asset> plants;
  DecodedImages images;  // all plants of a set have the same
  for (const std::string& name : names) {
    std::optional<Asset> plant = cached_plant(cache, name, images);
    if (!plant) break;
    plants.push_back(*std::move(plant));
  }
  if (plants.size() == names.size()) return plants;
  const std::vector<std::string> files = generate(brief, seed, count);
  keep(cache, names, files);
  plants.clear();
  // Read back, as all later runs will see them.
  for (std::size_t i = 0; i < files.size(); ++i) {
    plants.push_back(asset_of_glb(files[i], names[i], images));
  }
  return plants;
}

}  // namespace

PlantSet cached_plants(const VinesConfig& vines, std::uint64_t seed, const CacheFolder& cache) {
  const PlantBrief brief{vines, load_cultivar(vines.cultivar), growth_stage(vines.bbch), false};
  const int count = vines.templates + (vines.young > 0 ? kYoungTemplates : 0);
  PlantSet set;
  for (Asset& plant : load_or_generate(brief, seed, count, cache)) {
    const bool is_young = set.grown.size() == static_cast<std::size_t>(vines.templates);
    (is_young ? set.young : set.grown).push_back(std::move(plant));
  }
  return set;
}

}  // namespace vinebench::sim
