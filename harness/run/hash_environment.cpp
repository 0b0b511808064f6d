// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/hash_environment.h"

#include <set>

#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

constexpr const char* kProcessor = "processor";

}  // namespace

NamedValues hash_environment(const NamedValues& libraries) {
  NamedValues values{{"vinebench", kVersion}};
  for (const auto& value : arithmetic_of_process()) values.push_back(value);
  values.insert(values.end(), libraries.begin(), libraries.end());
  values.emplace_back(kProcessor, processor_text());
  return values;
}

std::string environment_differences(const NamedValues& a, const NamedValues& b) {
  const std::set<std::pair<std::string, std::string>> left(a.begin(), a.end());
  const std::set<std::pair<std::string, std::string>> right(b.begin(), b.end());
  std::set<std::string> names;
  for (const auto& value : left) {
    if (!right.contains(value)) names.insert(value.first);
  }
  for (const auto& value : right) {
    if (!left.contains(value)) names.insert(value.first);
  }
  names.erase(kProcessor);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace vinebench::harness
