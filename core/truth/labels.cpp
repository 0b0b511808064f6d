// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/labels.h"

#include <array>

namespace vinebench {
namespace {

/// In the order of Label.
constexpr std::array<const char*, kLabels> kLabelNames{
    "sky", "ground", "grass", "trunk",  "cane",  "leaf",      "bunch",      "post",    "wire",
    "tag", "box",    "rover", "person", "crate", "tarpaulin", "loose_leaf", "occluder"};

}  // namespace

const char* name_of(Label label) {
  return kLabelNames.at(static_cast<std::size_t>(label));
}

std::vector<std::string> yaml_names(Label) {
  return {kLabelNames.begin(), kLabelNames.end()};
}

std::optional<Label> label_named(std::string_view name) {
  for (std::size_t i = 0; i < kLabels; ++i) {
    if (kLabelNames[i] == name) return static_cast<Label>(i);
  }
  return std::nullopt;
}

std::string name_of(Thing thing) {
  static const std::array<const char*, 10> kNames{"none", "ground", "vine",  "post",  "tag",
                                                  "box",  "person", "rover", "cover", "occluder"};
  return kNames.at(static_cast<std::size_t>(thing));
}

}  // namespace vinebench
