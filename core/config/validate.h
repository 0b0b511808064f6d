// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/config/config_field.h"
#include "core/config/field_types.h"

namespace vinebench {

/// Checks the requirements and ranges of a struct that was not read from a file. Throws one Error
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
    } else if constexpr (field_types::IsOptional<T>::value) {
      if (value) check(key, *value, range);
    } else if constexpr (field_types::IsArray<T>::value || field_types::IsEigen<T>::value ||
                         field_types::IsVector<T>::value) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(value.size()); ++i) {
        check(fmt::format("{}.{}", key, i), value[i], range);
      }
    } else if constexpr (field_types::IsMap<T>::value) {
      for (auto& [name, item] : value) check(key + "." + name, item, range);
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
