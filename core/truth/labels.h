// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace vinebench {

/// What a pixel shows.
enum class Label : std::uint8_t {
  kSky,
  kGround,
  kGrass,
  kTrunk,
  kCane,
  kLeaf,
  kBunch,
  kPost,
  kWire,
  kTag,
  kBox,
  kRover,
  kPerson
};

/// What kind of thing an instance is.
enum class Thing {
  kNone,    ///< sky and wires
  kGround,  ///< the terrain's surface
  kVine,
  kPost,  ///< with struts and anchors
  kTag,
  kBox,
  kPerson,
  kRover,
  kCover  ///< what lies or grows on the ground: weeds, stones, fallen leaves, hedges, hills
};

/// "none", "ground", "vine" and so on.
std::string name_of(Thing thing);

/// What a number of RenderedImage::instances stands for.
struct InstanceName {
  Thing thing = Thing::kNone;
  int index = -1;     ///< into Scene::instances; -1 for kNone and kRover
  int id = -1;        ///< Instance::id: a vine's place in its world, a tag's place in the list
  int part = 0;       ///< from 1 on a bunch of a vine, counted within it
  std::string model;  ///< Model::name, such as a box's own
};

}  // namespace vinebench
