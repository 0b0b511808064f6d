// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/field_list.h"

#include <cxxabi.h>

#include <cmath>
#include <cstdlib>
#include <memory>

namespace vinebench {

std::string FieldLister::type_name(const std::type_info& type) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), std::free);
  return status == 0 ? name.get() : type.name();
}

namespace {

std::string range_text(const Range& range) {
  const bool has_min = std::isfinite(range.min);
  const bool has_max = std::isfinite(range.max);
  if (has_min && has_max) {
    return fmt::format("{}{} to {}", range.above_min ? "above " : "", range.min, range.max);
  }
  if (has_min) return fmt::format("{} {}", range.above_min ? "above" : "at least", range.min);
  return has_max ? fmt::format("at most {}", range.max) : "";
}

}  // namespace

void FieldLister::push(const std::string& key, std::string type, std::string value,
                       const Range& range) {
  fields_.push_back({full(key), owner_, key, std::move(type), std::move(value), range_text(range)});
}

}  // namespace vinebench
