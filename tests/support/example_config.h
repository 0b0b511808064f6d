// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"

namespace vinebench::test {

enum class Colour { kRed, kGreen };
inline std::vector<std::string> yaml_names(Colour) {
  return {"red", "green"};
}

struct Inner {
  double radius = 1;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("radius", radius, Range::positive());
  }
};

/// One field of each kind.
struct Outer {
  int count = 3;
  bool on = false;
  Colour colour = Colour::kRed;
  std::string name = "x";
  std::vector<std::string> names;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::optional<double> maybe;
  Inner inner;
  std::vector<Inner> list;
  std::map<std::string, Colour> colours;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("count", count, Range::between(0, 10));
    archive("on", on);
    archive("colour", colour);
    archive("name", name);
    archive("names", names);
    archive("position", position);
    archive("maybe", maybe);
    archive("inner", inner);
    archive("list", list);
    archive("colours", colours);
    archive.require(count != 7, "count", "expected anything but 7");
  }
};

}  // namespace vinebench::test
