// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/outcome.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "core/util/error.h"
#include "core/util/library_errors.h"
#include "tools/arguments/command.h"

namespace vinebench::tools {
namespace {

/// The command line, shortened: it names what was worked on.
std::string text_of(const std::vector<std::string>& arguments) {
  constexpr std::size_t kMost = 300;
  std::string text = fmt::format("{}", fmt::join(arguments, " "));
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace

int outcome_of(const std::vector<std::string>& arguments, const std::function<int()>& run) {
  try {
    return with_errors_of(text_of(arguments), run);
  } catch (const Error& error) {
    fmt::print(stderr, "vinebench: {}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vinebench: internal error: {}\n", error.what());
    return kInternalError;
  }
}

}  // namespace vinebench::tools
