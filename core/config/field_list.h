// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "core/config/config_field.h"
#include "core/config/field_types.h"

namespace vinebench {

/// A key of a configuration, for documents.
struct ConfigField {
  std::string key;      ///< dotted; N stands for the number of an entry, NAME for a chosen name
  std::string owner;    ///< the struct that lists it, "vinebench::sim::SunConfig"
  std::string own_key;  ///< the key there
  std::string type;     ///< "number", "3 numbers", "one of a, b", "map", "list of maps" …
  std::string value;    ///< the default as YAML; empty for a map of keys and where there is none
  std::string range;    ///< "0 to 1", "above 0"; empty if all values are valid
};

/// Lists the keys of a struct with their defaults, those of parts that are absent by default too.
/// See config_field.h.
class FieldLister {
 public:
  template <class T>
  void operator()(const std::string& key, T& value, const Range& range = {}) {
    add<T>(key, value, range);
  }
  void require(bool, const std::string&, const std::string&) {}

  /// The keys of a struct below a prefix.
  template <class T>
  void list(const std::string& prefix, T& value) {
    const std::string outer_prefix = std::exchange(prefix_, prefix);
    const std::string outer_owner = std::exchange(owner_, type_name(typeid(T)));
    value.serialize(*this);
    prefix_ = outer_prefix;
    owner_ = outer_owner;
  }

  const std::vector<ConfigField>& fields() const { return fields_; }

 private:
  static constexpr const char* kMap = "map";

  static std::string type_name(const std::type_info& type);
  static std::string text_of(bool value) { return value ? "true" : "false"; }
  static std::string text_of(const std::string& value) {
    return value.empty() ? "\"\"" : fmt::format("\"{}\"", value);
  }
  static std::string text_of(const std::filesystem::path& value) { return value.string(); }
  template <class T>
  static std::string text_of(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      return yaml_names(T{}).at(static_cast<std::size_t>(value));
    } else {
      return fmt::format("{}", value);
    }
  }
  template <class T>
  static constexpr bool is_scalar() {
    return std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string> ||
           std::is_same_v<T, std::filesystem::path>;
  }
  template <class T>
  static constexpr bool is_sequence() {
    return field_types::IsArray<T>::value || field_types::IsEigen<T>::value ||
           field_types::IsVector<T>::value;
  }

  /// A scalar in the singular, or so many.
  template <class T>
  static std::string scalar_type(const std::string& count = "") {
    const std::string plural = count.empty() ? "" : "s";
    const std::string before = count.empty() ? "" : count + " ";
    if constexpr (std::is_enum_v<T>) {
      return fmt::format("{}{}", count.empty() ? "one of " : count + " of ",
                         fmt::join(yaml_names(T{}), ", "));
    } else {
      const char* name = std::is_same_v<T, bool>                    ? "true or false"
                         : std::is_integral_v<T>                    ? "whole number"
                         : std::is_arithmetic_v<T>                  ? "number"
                         : std::is_same_v<T, std::filesystem::path> ? "file"
                                                                    : "text";
      return before + name + plural;
    }
  }

  void push(const std::string& key, std::string type, std::string value, const Range& range);
  std::string full(const std::string& key) const {
    return prefix_.empty() ? key : prefix_ + "." + key;
  }

  template <class T>
  void add(const std::string& key, T& value, const Range& range) {
    if constexpr (field_types::IsOptional<T>::value) {
      add_optional<typename T::value_type>(key, value, range);
    } else if constexpr (is_scalar<T>()) {
      push(key, scalar_type<T>(), text_of(value), range);
    } else if constexpr (is_sequence<T>()) {
      add_sequence(key, value, range);
    } else if constexpr (field_types::IsMap<T>::value) {
      add_map(key, value, range);
    } else {
      push(key, kMap, "", {});
      list(full(key), value);
    }
  }

  /// One with its defaults.
  template <class T>
  static T blank() {
    if constexpr (field_types::IsEigen<T>::value) {
      return T::Zero();
    } else {
      return T{};
    }
  }

  template <class T>
  void add_optional(const std::string& key, std::optional<T>& value, const Range& range) {
    const std::size_t place = fields_.size();
    T inner = value ? *value : blank<T>();
    add<T>(key, inner, range);
    if (value) return;
    fields_[place].value.clear();
    if (fields_[place].type == kMap) fields_[place].type += ", absent by default";
  }

  template <class T>
  void add_sequence(const std::string& key, T& value, const Range& range) {
    using Item = std::decay_t<decltype(value[0])>;
    constexpr bool any_number = field_types::IsVector<T>::value;
    if constexpr (is_scalar<Item>()) {
      std::vector<std::string> items;
      for (std::size_t i = 0; i < static_cast<std::size_t>(value.size()); ++i) {
        items.push_back(text_of(Item(value[i])));
      }
      push(key, scalar_type<Item>(any_number ? "any number of" : std::to_string(value.size())),
           fmt::format("[{}]", fmt::join(items, ", ")), range);
    } else {
      push(key, is_sequence<Item>() ? "list of lists" : "list of maps",
           value.size() == 0 ? "[]" : "", {});
      Item item = blank<Item>();
      add_entry(key + ".N", item, range);
    }
  }

  template <class T>
  void add_map(const std::string& key, T& value, const Range& range) {
    typename T::mapped_type item{};
    push(key, "map by name", value.empty() ? "{}" : "", {});
    add_entry(key + ".NAME", item, range);
  }

  /// The keys of an entry alone, where it has keys.
  template <class Item>
  void add_entry(const std::string& key, Item& item, const Range& range) {
    if constexpr (is_scalar<Item>() || is_sequence<Item>() || field_types::IsMap<Item>::value) {
      const std::size_t place = fields_.size();
      add<Item>(key, item, range);
      fields_[place].value.clear();
    } else {
      list(full(key), item);
    }
  }

  std::string prefix_;
  std::string owner_;
  std::vector<ConfigField> fields_;
};

/// The keys of a struct with its defaults.
template <class T>
std::vector<ConfigField> list_fields() {
  FieldLister lister;
  T value{};
  lister.list("", value);
  return lister.fields();
}

}  // namespace vinebench
