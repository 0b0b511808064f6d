// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/warning.h"

#include <mutex>
#include <set>
#include <utility>

namespace vinebench {
namespace {

struct Warnings {
  std::mutex mutex;
  WarningSink sink;
  std::set<std::string> given;
};

Warnings& warnings() {
  static Warnings all;
  return all;
}

}  // namespace

WarningSink set_warning_sink(WarningSink sink) {
  Warnings& all = warnings();
  const std::scoped_lock lock(all.mutex);
  all.given.clear();
  return std::exchange(all.sink, std::move(sink));
}

void warn(const std::string& text) {
  Warnings& all = warnings();
  const std::scoped_lock lock(all.mutex);
  if (all.sink && all.given.insert(text).second) all.sink(text);
}

}  // namespace vinebench
