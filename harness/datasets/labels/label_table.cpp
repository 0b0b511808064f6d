// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/label_table.h"

#include <fmt/format.h>

namespace vinebench::harness {
namespace {

struct Entry {
  cv::Vec3b colour;
  Category category;
};

/// In the order of Label.
const std::array<Entry, kLabels>& entries() {
  static const std::array<Entry, kLabels> kEntries{{{{135, 190, 235}, Category::kSky},
                                                    {{150, 110, 70}, Category::kGround},
                                                    {{120, 190, 80}, Category::kGrass},
                                                    {{95, 60, 30}, Category::kTrunk},
                                                    {{190, 140, 60}, Category::kCane},
                                                    {{30, 130, 40}, Category::kLeaf},
                                                    {{120, 40, 140}, Category::kBunch},
                                                    {{200, 200, 90}, Category::kPost},
                                                    {{90, 90, 110}, Category::kWire},
                                                    {{255, 255, 255}, Category::kTag},
                                                    {{220, 150, 80}, Category::kBox},
                                                    {{220, 40, 40}, Category::kRover},
                                                    {{250, 170, 190}, Category::kPerson},
                                                    {{200, 110, 60}, Category::kBox},
                                                    {{70, 110, 220}, Category::kOccluder},
                                                    {{160, 220, 30}, Category::kOccluder},
                                                    {{110, 110, 160}, Category::kOccluder}}};
  return kEntries;
}

}  // namespace

cv::Vec3b label_colour(std::uint8_t label) {
  return label < kLabels ? entries()[label].colour : cv::Vec3b(0, 0, 0);
}

std::string label_table_text() {
  std::string text = "labels:\n";
  for (std::size_t i = 0; i < kLabels; ++i) {
    const cv::Vec3b& colour = entries()[i].colour;
    text += fmt::format("  - {{id: {}, name: {}, colour: [{}, {}, {}]}}\n", i,
                        name_of(static_cast<Label>(i)), colour[0], colour[1], colour[2]);
  }
  return text;
}

const char* category_name(Category category) {
  static constexpr std::array<const char*, kCategories> kNames{
      "bunch",  "plant", "trunk", "cane",  "leaf",   "post", "tag",     "box",
      "person", "rover", "wire",  "grass", "ground", "sky",  "occluder"};
  return kNames.at(static_cast<std::size_t>(category));
}

Category category_of(Label label) {
  return entries().at(static_cast<std::size_t>(label)).category;
}

}  // namespace vinebench::harness
