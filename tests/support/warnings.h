// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/util/warning.h"

namespace vinebench::test {

/// Keeps the warnings that are given during its life.
class Warnings {
 public:
  Warnings()
      : before_(set_warning_sink([this](const std::string& text) { all.push_back(text); })) {}
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  ~Warnings() { set_warning_sink(before_); }

  std::vector<std::string> all;

 private:
  WarningSink before_;
};

}  // namespace vinebench::test
