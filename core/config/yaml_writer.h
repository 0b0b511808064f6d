// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <type_traits>

#include "core/config/config_field.h"
#include "core/config/field_types.h"

namespace vinebench {

/// Writes a struct as YAML, every field with its value. See config_field.h.
class YamlWriter {
 public:
  template <class T>
  void operator()(const std::string& key, T& value, const Range& = {}) {
    if constexpr (field_types::IsOptional<T>::value) {
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
    } else if constexpr (field_types::IsMap<T>::value) {
      write_map(value);
    } else if constexpr (field_types::IsArray<T>::value || field_types::IsEigen<T>::value ||
                         field_types::IsVector<T>::value) {
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
  void write_map(T& value) {
    if (value.empty()) {
      text_.back() = ' ';
      text_ += "{}\n";
    }
    ++depth_;
    for (auto& [name, item] : value) (*this)(quote(name), item);
    --depth_;
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

}  // namespace vinebench
