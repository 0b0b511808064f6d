// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vinebench {

/// The class of a pixel.
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
  kPerson,
  kCrate,
  kTarpaulin,
  kLooseLeaf,  ///< a leaf or shoot that was put before the cameras, not of a plant
  kOccluder    ///< other things that were put before the cameras
};
inline constexpr std::size_t kLabels = 17;

/// "sky", "ground" and so on: what files store, for a label's number changes when one is inserted.
/// Throws std::out_of_range for a number that is no label.
const char* name_of(Label label);

/// All names, in the order of Label.
std::vector<std::string> yaml_names(Label);

/// The label of that name, if there is one.
std::optional<Label> label_named(std::string_view name);

/// The kind of an instance.
enum class Thing {
  kNone,    ///< sky and wires
  kGround,  ///< the terrain's surface
  kVine,
  kPost,  ///< with struts and anchors
  kTag,
  kBox,  ///< cartons and crates
  kPerson,
  kRover,
  kCover,    ///< on the ground: weeds, stones, fallen leaves, hedges, hills
  kOccluder  ///< other things that were put before the cameras
};

/// "none", "ground", "vine" and so on.
std::string name_of(Thing thing);

/// The meaning of a number of RenderedImage::instances.
struct InstanceName {
  Thing thing = Thing::kNone;
  int index = -1;     ///< into Scene::instances; -1 for kNone and kRover
  int id = -1;        ///< Instance::id: a vine's index in its world, a tag's index in the list
  int part = 0;       ///< bunch of a vine, from 1
  std::string model;  ///< Model::name, such as a box's own
};

}  // namespace vinebench
