// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/util/random.h"
#include "sim/world/tag_family.h"

namespace vinebench::sim {
std::string WorldConfig::tag_problem(const std::string& family, int id) {
  if (!TagFamily::known(family)) {
    std::string names;
    for (const std::string& name : TagFamily::names()) names += (names.empty() ? "" : ", ") + name;
    return fmt::format("expected a family of {}, found {}", names, family);
  }
  const int size = TagFamily(family).size();
  if (id >= 0 && id < size) return "";
  return fmt::format("expected 0 to {} for {}, found {}", size - 1, family, id);
}

bool WorldConfig::has_sound_rows() const {
  return (block || !rows.empty()) && std::ranges::all_of(rows, [](const Row& row) {
           return (row.end - row.start).norm() > kShortestRow;
         });
}

VineKind vine_at(const WorldConfig& world, std::uint64_t seed, std::size_t place) {
  const double draw = RandomStream(seed, "vine gaps").uniform(place);
  if (draw < world.vines.missing) return VineKind::kNone;
  return draw < world.vines.missing + world.vines.young ? VineKind::kYoung : VineKind::kGrown;
}

}  // namespace vinebench::sim
