// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
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
// That one list reads it strictly (YamlDocument::read), writes it with all defaults resolved
// (format_yaml) and documents its keys. Fields may be bool, int, std::int64_t, std::uint64_t,
// double, std::string, std::filesystem::path, Eigen vectors, std::array, std::vector,
// std::optional, other such structs, and enums with a `yaml_names(Enum)` that gives their names in
// order. A path names a file that must exist, relative to the YAML file it stands in.

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

class YamlReader;

/// A YAML file with where each part of it came from: its own lines, files it names, and overrides
/// from the command line.
class YamlDocument {
 public:
  /// Throws Error when the file cannot be read or is no YAML (with its line).
  static YamlDocument load(const std::filesystem::path& file);

  /// Replaces the top-level scalar `key`, a file name relative to this file, by that file's
  /// content. Nothing happens where the key is absent or already a map.
  void include(const std::string& key);

  /// Takes over what this document does not say itself from the file that the top-level scalar
  /// `key` names, relative to this file: maps are joined key by key, all else counts as a whole. A
  /// base may have a base; `parts` are included in it. Nothing happens where the key is absent.
  /// Throws Error for a missing file and for bases that go round in a circle.
  void inherit(const std::string& key, const std::vector<std::string>& parts) {
    inherit(key, parts, 0);
  }

  /// Sets a dotted key ("slam.tracking.radius", "route.2.speed") to the YAML value `value`. A key
  /// that no struct knows is reported when the document is read.
  void set(const std::string& key, const std::string& value);

  /// Reads the whole document into a struct. Throws one Error that lists every violation, a line
  /// each: unknown or duplicate key, wrong type, number out of range, failed requirement.
  template <class T>
  T read() const;

 private:
  friend class YamlReader;
  void inherit(const std::string& key, const std::vector<std::string>& parts, int depth);
  void overlay(YAML::Node target, const YAML::Node& source, const std::string& prefix,
               const std::filesystem::path& file);
  std::filesystem::path file_of(const std::string& key) const;
  std::string place_of(const std::string& key, const YAML::Node& node) const;

  YAML::Node root_;
  std::map<std::string, std::filesystem::path> files_;  ///< by the dotted key they begin at
  std::map<std::string, std::string> overrides_;        ///< dotted key to the value given
};

namespace yaml_detail {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
template <class T>
struct IsEigen : std::false_type {};
template <class S, int R>
struct IsEigen<Eigen::Matrix<S, R, 1>> : std::bool_constant<(R > 0)> {};

}  // namespace yaml_detail

/// Reads a struct out of a document and gathers every violation. See the comment on top.
class YamlReader {
 public:
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

  /// Reports keys that no field asked for, and keys that stand twice.
  void finish();

 private:
  YAML::Node find(const std::string& key) const;
  std::string full(const std::string& key) const {
    return prefix_.empty() ? key : prefix_ + "." + key;
  }
  void violation(const std::string& key, const YAML::Node& node, const std::string& text);
  bool expect_sequence(const YAML::Node& node, const std::string& key, std::size_t size);

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
      std::int64_t wide = static_cast<std::int64_t>(value);
      read_integer(node, key, wide, range);
      if (!std::in_range<T>(wide)) {
        violation(key, node,
                  fmt::format("expected a whole number from {} to {}",
                              std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
        return;
      }
      value = static_cast<T>(wide);
    } else if constexpr (std::is_enum_v<T>) {
      int index = static_cast<int>(value);
      read_name(node, key, yaml_names(T{}), index);
      value = static_cast<T>(index);
    } else if constexpr (yaml_detail::IsOptional<T>::value) {
      if (node.IsNull()) {
        value.reset();
      } else {
        read(node, key, value.emplace(), range);
      }
    } else if constexpr (yaml_detail::IsVector<T>::value) {
      value.clear();
      if (node.IsScalar() && !std::is_class_v<typename T::value_type>) {
        read(node, key, value.emplace_back(), range);  // one number stands for a list of one
      } else if (node.IsScalar() && std::is_same_v<typename T::value_type, std::string>) {
        read(node, key, value.emplace_back(), range);  // so does one name
      } else if (expect_sequence(node, key, node.size())) {
        value.resize(node.size());
        for (std::size_t i = 0; i < node.size(); ++i) {
          read(node[i], fmt::format("{}.{}", key, i), value[i], range);
        }
      }
    } else if constexpr (yaml_detail::IsArray<T>::value || yaml_detail::IsEigen<T>::value) {
      const auto size = static_cast<std::size_t>(value.size());
      if (!expect_sequence(node, key, size)) return;
      for (std::size_t i = 0; i < size; ++i) {
        read(node[i], fmt::format("{}.{}", key, i), value[i], range);
      }
    } else {
      if (!node.IsMap() && !node.IsNull()) {
        violation(key, node, "expected a map of keys");
        return;
      }
      YamlReader reader(document_, node, key, violations_);
      value.serialize(reader);
      reader.finish();
    }
  }

  const YamlDocument& document_;
  YAML::Node node_;
  std::string prefix_;
  std::vector<std::string>& violations_;
  std::set<std::string> known_;
};

/// Throws the Error that `read` promises, when there is any violation.
void throw_violations(const std::vector<std::string>& violations);

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

/// Writes a struct as YAML, every field with its value. See the comment on top.
class YamlWriter {
 public:
  template <class T>
  void operator()(const std::string& key, T& value, const Range& = {}) {
    if constexpr (yaml_detail::IsOptional<T>::value) {
      if (value) (*this)(key, *value);
    } else {
      line(key + ":");
      write(value);
    }
  }
  void require(bool, const std::string&, const std::string&) {}

  const std::string& text() const { return text_; }

 private:
  void line(const std::string& content);
  static std::string quote(const std::string& value);
  static std::string scalar(bool value) { return value ? "true" : "false"; }
  static std::string scalar(double value);
  static std::string scalar(const std::string& value) { return quote(value); }
  static std::string scalar(const std::filesystem::path& value) { return quote(value.string()); }
  template <class T>
  static std::string scalar(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      return yaml_names(T{}).at(static_cast<std::size_t>(value));
    } else {
      return std::to_string(value);
    }
  }
  template <class T>
  static constexpr bool is_scalar() {
    return std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string> ||
           std::is_same_v<T, std::filesystem::path>;
  }

  template <class T>
  void write(T& value) {
    if constexpr (is_scalar<T>()) {
      text_.back() = ' ';
      text_ += scalar(value) + "\n";
    } else if constexpr (yaml_detail::IsArray<T>::value || yaml_detail::IsEigen<T>::value ||
                         yaml_detail::IsVector<T>::value) {
      write_sequence(value);
    } else {
      ++depth_;
      const std::size_t before = text_.size();
      value.serialize(*this);
      --depth_;
      if (text_.size() == before) {
        text_.back() = ' ';
        text_ += "{}\n";
      }
    }
  }

  template <class T>
  void write_sequence(T& value) {
    using Item = std::remove_reference_t<decltype(value[0])>;
    const auto size = static_cast<std::size_t>(value.size());
    if (is_scalar<Item>() || size == 0) {
      std::string items;
      if constexpr (is_scalar<Item>()) {
        for (std::size_t i = 0; i < size; ++i) items += (i ? ", " : "") + scalar(value[i]);
      }
      text_.back() = ' ';
      text_ += "[" + items + "]\n";
      return;
    }
    if constexpr (!is_scalar<Item>()) {
      ++depth_;
      for (std::size_t i = 0; i < size; ++i) {
        line("-");
        write(value[i]);
      }
      --depth_;
    }
  }

  std::string text_;
  int depth_ = 0;
};

/// The YAML text of a struct with all its defaults resolved.
template <class T>
std::string format_yaml(T value) {
  YamlWriter writer;
  value.serialize(writer);
  return writer.text();
}

/// Checks the requirements and ranges of a struct that did not come from a file; throws one Error
/// that lists every violation.
template <class T>
void validate(T value);

/// Archive behind validate().
class Validator {
 public:
  template <class T>
  void operator()(const std::string& key, T& value, const Range& range = {}) {
    check(prefix_.empty() ? key : prefix_ + "." + key, value, range);
  }
  void require(bool ok, const std::string& key, const std::string& expectation) {
    if (!ok)
      violations_.push_back(prefix_ + (prefix_.empty() ? "" : ".") + key + ": " + expectation);
  }
  const std::vector<std::string>& violations() const { return violations_; }

 private:
  template <class T>
  void check(const std::string& key, T& value, const Range& range) {
    if constexpr (std::is_arithmetic_v<T>) {
      const auto number = static_cast<double>(value);
      if (!std::isfinite(number) || !range.contains(number)) {
        violations_.push_back(fmt::format("{}: expected {}, found {}", key, range.text(), value));
      }
    } else if constexpr (yaml_detail::IsOptional<T>::value) {
      if (value) check(key, *value, range);
    } else if constexpr (yaml_detail::IsArray<T>::value || yaml_detail::IsEigen<T>::value ||
                         yaml_detail::IsVector<T>::value) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(value.size()); ++i) {
        check(fmt::format("{}.{}", key, i), value[i], range);
      }
    } else if constexpr (!std::is_enum_v<T> && !std::is_same_v<T, std::string> &&
                         !std::is_same_v<T, std::filesystem::path>) {
      const std::string outer = std::exchange(prefix_, key);
      value.serialize(*this);
      prefix_ = outer;
    }
  }

  std::string prefix_;
  std::vector<std::string> violations_;
};

template <class T>
void validate(T value) {
  Validator validator;
  value.serialize(validator);
  throw_violations(validator.violations());
}

}  // namespace vinebench
