// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace vinebench {

// A configuration is a plain struct with defaults and one member function that lists its fields:
//
//     template <class Archive>
//     void serialize(Archive& archive) {
//       archive("radius", radius, Range::positive());
//       archive.require(low <= high, "low", "expected at most high");
//     }
//
// This list is used to read it strictly (YamlDocument::read in yaml.h), write it with all defaults
// resolved (format_yaml in yaml_writer.h), validate it (validate in validate.h) and document its
// keys. Fields may be bool, int, std::int64_t, std::uint64_t, double, std::string,
// std::filesystem::path, Eigen vectors, std::array, std::vector, std::map from std::string (a map
// whose keys the user chooses), std::optional, other such structs, and enums with a
// `yaml_names(Enum)` that returns their names in order. A path must name an
// existing file, relative to the YAML file.

/// The valid range of a numeric field, and its text for error messages.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above_min = false;  ///< min itself is excluded

  static constexpr Range positive() { return {0, std::numeric_limits<double>::infinity(), true}; }
  static constexpr Range non_negative() { return {0}; }
  static constexpr Range between(double min, double max) { return {min, max}; }

  bool contains(double value) const {
    return (above_min ? value > min : value >= min) && value <= max;
  }
  std::string text() const;
};

/// Throws one Error that lists all violations, one a line; returns if there are none.
void throw_violations(const std::vector<std::string>& violations);

}  // namespace vinebench
