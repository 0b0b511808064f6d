// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/plants/cultivar.h"
#include "sim/plants/grapevine_stage.h"
#include "sim/scene/mesh_builder.h"
#include "sim/world/vines.h"

namespace vinebench::sim {

/// A bunch of berries (before fruit set, of flowers) that hangs from its shoot.
struct Bunch {
  Eigen::Vector3f top;           ///< m, of its shoulders
  float length = 0.12f;          ///< m, top to the lowest berry's underside
  float radius = 0.033f;         ///< m, at its widest
  float berry_radius = 0.0075f;  ///< m, mean
  float shoulder = 0.5f;         ///< 0 a cylinder, 1 a cone
  float compactness = 0.8f;      ///< 0 berries hang apart, 1 they press on each other
  float ripeness = 0;            ///< against the plants' mean, as a share of the berries' variants
  Eigen::Vector2f wing{0, 0};    ///< m, of the small bunch beside its shoulder; none where 0
  std::uint64_t berry_seed = 0;  ///< for where each berry sits and what colour it has
};

/// A leaf's stalk.
struct Petiole {
  Eigen::Vector3f from, to;  ///< m
  float radius = 0.0015f;    ///< m, at the shoot
};

/// One vine on a wire trellis: shoots stand upright between the wires, the fruit hangs round their
/// lowest nodes. Model frame: origin on the ground in the middle of the plant's share of the row,
/// x along the row, z up; m. The foot is there too, but for wood led to one side only: that begins
/// at the share's end.
struct Grapevine {
  std::vector<Tube> wood;              ///< trunk, then cordon arms
  std::vector<Tube> canes;             ///< last year's: spurs, and canes laid on the wire
  std::vector<Tube> shoots;            ///< this year's
  std::vector<Tube> stalks;            ///< of bunches, and tendrils
  std::vector<Petiole> petioles;       ///< one a leaf
  std::vector<BladePlacement> leaves;  ///< no part further than half_depth from the row's plane
  std::vector<Bunch> bunches;          ///< none below lowest_bunch, one exactly there
  std::optional<Tube> shelter;         ///< the grow tube of a young plant
  float half_depth = 0.15f;            ///< m
  float half_share = 0.5f;             ///< m, half the plant's share of the row
};

/// What a plant is grown to.
struct PlantBrief {
  VinesConfig vines;  ///< all but templates, meshes and shares
  Cultivar cultivar;
  GrowthStage stage;
  bool young = false;  ///< second year: a thin stem with a few leaves in a grow tube
};

/// Plants are enlarged by up to this when they are set into a row; they are grown that much
/// narrower.
inline constexpr double kLargestPlantScale = 1.03;

}  // namespace vinebench::sim
