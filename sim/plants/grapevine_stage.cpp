// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_stage.h"

#include <algorithm>
#include <array>

#include "core/util/error.h"
#include "sim/world/vines.h"

namespace vinebench::sim {
namespace {

constexpr std::array<GrowthStage, 8> kStages{{
    // code, name, shoot, leaf, foliage, autumn, bunch, berry, ripe, lignified
    {0, "dormant", 0, 0, 0, 0, 0, 0, 0, 1},
    {9, "budburst", 0.03f, 0.22f, 0, 0, 0, 0, 0, 0},
    {65, "flowering", 0.80f, 0.82f, 0.50f, 0, 0.75f, 0.24f, 0, 0},
    {75, "pea-size", 1, 0.95f, 0.90f, 0, 0.90f, 0.48f, 0, 0.1f},
    {79, "bunch closure", 1, 1, 1, 0, 0.97f, 0.72f, 0, 0.2f},
    {83, "veraison", 1, 1, 1, 0, 1, 0.85f, 0.5f, 0.35f},
    {89, "harvest", 1, 1, 1, 0.03f, 1, 1, 1, 0.6f},
    {95, "leaf fall", 1, 1, 0.5f, 0.8f, 0, 0, 0, 1},
}};

const GrowthStage* find(int bbch) {
  const auto stage = std::ranges::find(kStages, bbch, &GrowthStage::bbch);
  return stage == kStages.end() ? nullptr : &*stage;
}

}  // namespace

std::string bbch_problem(int bbch) {
  if (find(bbch) != nullptr) return "";
  std::string names;
  for (const GrowthStage& stage : kStages) {
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", stage.bbch, stage.name);
  }
  return fmt::format("expected one of {}, found {}", names, bbch);
}

const GrowthStage& growth_stage(int bbch) {
  const GrowthStage* stage = find(bbch);
  if (stage == nullptr) fail("growth stage: {}", bbch_problem(bbch));
  return *stage;
}

double withered_share(int bbch) {
  const GrowthStage& stage = growth_stage(bbch);
  if (stage.shoot == 0) return 0.7;
  if (stage.shoot < 0.1f) return 0.35;
  return stage.autumn > 0.5f ? 0.45 : 0.15;
}

double usual_overcast(int bbch) {
  return growth_stage(bbch).shoot == 0 ? 0.75 : 0;
}

}  // namespace vinebench::sim
