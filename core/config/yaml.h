// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/config/config_field.h"
#include "core/config/field_types.h"

namespace vinebench {

class YamlReader;

/// The tree of a YAML file, for files of which only some keys are known. Throws Error if the file
/// cannot be read, exceeds 4 MiB, is not valid YAML, has an alias inside of what it refers to, or
/// more than 64 levels (with the line).
YAML::Node load_yaml_tree(const std::filesystem::path& file);

/// A YAML file and the origin of each of its parts: its own lines, included files, and overrides
/// from the command line.
class YamlDocument {
 public:
  /// Throws Error as load_yaml_tree() does, and if the file is not a map.
  static YamlDocument load(const std::filesystem::path& file);

  /// Replaces the top-level scalar `key`, a file name relative to this file, by that file's
  /// content. No effect if the key is absent or already a map.
  void include(const std::string& key);

  /// Inherits keys from the file that the top-level scalar `key` names, relative to this file: maps
  /// are merged key by key, other values of this document replace those of the base. A base may
  /// have a base; `parts` are included in it, and top-level keys of `own` are not inherited. No
  /// effect if the key is absent. Throws Error for a missing file and for bases that go round in a
  /// circle.
  void inherit(const std::string& key, const std::vector<std::string>& parts,
               const std::vector<std::string>& own = {}) {
    inherit(key, parts, own, {});
  }

  /// Sets a dotted key ("slam.tracking.radius", "route.2.speed") to the YAML value `value`. An
  /// unknown key is reported by read().
  void set(const std::string& key, const std::string& value);

  /// Reads the whole document into a struct. Throws one Error that lists every violation, one a
  /// line: unknown or duplicate key, wrong type, number out of range, failed requirement.
  template <class T>
  T read() const;

 private:
  friend class YamlReader;
  void inherit(const std::string& key, const std::vector<std::string>& parts,
               const std::vector<std::string>& own, std::vector<std::filesystem::path> derived);
  void overlay(YAML::Node target, const YAML::Node& source, const std::string& prefix,
               const std::filesystem::path& file);
  std::filesystem::path file_of(const std::string& key) const;
  std::string place_of(const std::string& key, const YAML::Node& node) const;

  YAML::Node root_;
  std::map<std::string, std::filesystem::path> files_;  ///< by the dotted key of their root
  std::map<std::string, std::string> overrides_;        ///< dotted key to value
};

/// Reads a struct from a document and collects every violation. See config_field.h.
class YamlReader {
 public:
  static constexpr bool kReads = true;  ///< for presets: what follows is read over their values

  YamlReader(const YamlDocument& document, YAML::Node node, std::string prefix,
             std::vector<std::string>& violations)
      : document_(document),
        node_(std::move(node)),
        prefix_(std::move(prefix)),
        violations_(violations) {}

  template <class T>
  void operator()(const std::string& key, T& value, const Range& range = {}) {
    known_.insert(key);
    if (const YAML::Node child = find(key); child.IsDefined()) {
      read(child, full(key), value, range);
    }
  }

  void require(bool ok, const std::string& key, const std::string& expectation);

  /// Reports unknown and duplicate keys.
  void finish();

 private:
  YAML::Node find(const std::string& key) const;
  std::string full(const std::string& key) const {
    return prefix_.empty() ? key : prefix_ + "." + key;
  }
  void violation(const std::string& key, const YAML::Node& node, const std::string& text);
  bool expect_sequence(const YAML::Node& node, const std::string& key, std::size_t size);
  bool expect_map(const YAML::Node& node, const std::string& key);

  void read(const YAML::Node& node, const std::string& key, bool& value, const Range&);
  void read(const YAML::Node& node, const std::string& key, double& value, const Range& range);
  void read(const YAML::Node& node, const std::string& key, std::string& value, const Range&);
  void read(const YAML::Node& node, const std::string& key, std::filesystem::path& value,
            const Range&);
  void read_integer(const YAML::Node& node, const std::string& key, std::int64_t& value,
                    const Range& range);
  void read_name(const YAML::Node& node, const std::string& key,
                 const std::vector<std::string>& names, int& value);

  template <class T>
  void read(const YAML::Node& node, const std::string& key, T& value, const Range& range) {
    if constexpr (std::is_integral_v<T>) {
      read_whole_number(node, key, value, range);
    } else if constexpr (std::is_enum_v<T>) {
      int index = static_cast<int>(value);
      read_name(node, key, yaml_names(T{}), index);
      value = static_cast<T>(index);
    } else if constexpr (field_types::IsOptional<T>::value) {
      read_optional(node, key, value, range);
    } else if constexpr (field_types::IsVector<T>::value) {
      read_vector(node, key, value, range);
    } else if constexpr (field_types::IsArray<T>::value || field_types::IsEigen<T>::value) {
      const auto size = static_cast<std::size_t>(value.size());
      if (expect_sequence(node, key, size)) read_elements(node, key, value, range);
    } else if constexpr (field_types::IsMap<T>::value) {
      read_map(node, key, value, range);
    } else {
      read_struct(node, key, value);
    }
  }

  template <class T>
  void read_whole_number(const YAML::Node& node, const std::string& key, T& value,
                         const Range& range) {
    auto wide = static_cast<std::int64_t>(value);
    read_integer(node, key, wide, range);
    if (!std::in_range<T>(wide)) {
      violation(key, node,
                fmt::format("expected a whole number from {} to {}", std::numeric_limits<T>::min(),
                            std::numeric_limits<T>::max()));
      return;
    }
    value = static_cast<T>(wide);
  }

  template <class T>
  void read_optional(const YAML::Node& node, const std::string& key, std::optional<T>& value,
                     const Range& range) {
    if (node.IsNull()) {
      value.reset();
    } else if constexpr (field_types::IsEigen<T>::value) {
      read(node, key, value.emplace(), range);
    } else {
      // Not emplace(): to Clang a nested struct with defaults has no default constructor yet.
      read(node, key, value.emplace(T{}), range);
    }
  }

  template <class T>
  void read_vector(const YAML::Node& node, const std::string& key, std::vector<T>& value,
                   const Range& range) {
    value.clear();
    if (node.IsScalar() && (!std::is_class_v<T> || std::is_same_v<T, std::string>)) {
      read(node, key, value.emplace_back(), range);  // a single number or name is a list of one
    } else if (expect_sequence(node, key, node.size())) {
      value.resize(node.size());
      read_elements(node, key, value, range);
    }
  }

  template <class T>
  void read_elements(const YAML::Node& node, const std::string& key, T& value, const Range& range) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      read(node[i], fmt::format("{}.{}", key, i), value[i], range);
    }
  }

  template <class T>
  void read_map(const YAML::Node& node, const std::string& key, T& value, const Range& range) {
    value.clear();
    if (!expect_map(node, key)) return;
    for (const auto& item : node) {
      const std::string name = item.first.Scalar();
      const std::string dotted = key + "." + name;
      if (value.contains(name)) {
        violations_.push_back(
            fmt::format("{}: {}: duplicate key", document_.place_of(dotted, item.first), dotted));
      }
      read(item.second, dotted, value[name], range);
    }
  }

  template <class T>
  void read_struct(const YAML::Node& node, const std::string& key, T& value) {
    if (!node.IsMap() && !node.IsNull()) {
      violation(key, node, "expected a map of keys");
      return;
    }
    YamlReader reader(document_, node, key, violations_);
    value.serialize(reader);
    reader.finish();
  }

  const YamlDocument& document_;
  YAML::Node node_;
  std::string prefix_;
  std::vector<std::string>& violations_;
  std::set<std::string> known_;
};

template <class T>
T YamlDocument::read() const {
  T value{};
  std::vector<std::string> violations;
  YamlReader reader(*this, root_, "", violations);
  value.serialize(reader);
  reader.finish();
  throw_violations(violations);
  return value;
}

}  // namespace vinebench
