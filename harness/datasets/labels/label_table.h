// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/truth/labels.h"

namespace vinebench::harness {

/// RGB, for the camera; black for a number that is no Label.
cv::Vec3b label_colour(std::uint8_t label);

/// YAML: a list `labels` of `{id, name, colour}`.
std::string label_table_text();

/// Categories of COCO, ids from 1 on in this order.
enum class Category {
  kBunch,
  kPlant,
  kTrunk,
  kCane,
  kLeaf,
  kPost,
  kTag,
  kBox,
  kPerson,
  kRover,
  kWire,
  kGrass,
  kGround,
  kSky,
  kOccluder
};
inline constexpr std::size_t kCategories = 15;

inline int category_id(Category category) {
  return static_cast<int>(category) + 1;
}
const char* category_name(Category category);

/// Of one pixel; a plant is the union of its parts and no label's own.
Category category_of(Label label);

/// A thing can be counted; wire, grass, ground and sky cannot.
inline bool is_thing(Category category) {
  return category < Category::kWire || category == Category::kOccluder;
}

}  // namespace vinebench::harness
