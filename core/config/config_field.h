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
// That one list reads it strictly (YamlDocument::read in yaml.h), writes it with all defaults
// resolved (format_yaml in yaml_writer.h), checks it (validate in validate.h) and documents its
// keys. Fields may be bool, int, std::int64_t, std::uint64_t, double, std::string,
// std::filesystem::path, Eigen vectors, std::array, std::vector, std::optional, other such structs,
// and enums with a `yaml_names(Enum)` that gives their names in order. A path names a file that
// must exist, relative to the YAML file it stands in.

/// The numbers a field may take; also the text of the error when it does not.
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

/// Throws one Error that lists the violations, a line each, when there is any.
void throw_violations(const std::vector<std::string>& violations);

}  // namespace vinebench
