// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/util/error.h"

namespace vinebench::harness {

/// Why a system under test ended before its run did.
struct SlamFailure {
  std::string cause;
  std::optional<std::int64_t> frame;  ///< the one that it was given; none after the last one
};

/// The system under test has failed by itself: it crashed, ended, exceeded a limit or answered what
/// cannot be. The run ends with that as its verdict; other Errors are bad input.
class SystemFailure : public Error {
 public:
  using Error::Error;
};

/// Throws a SystemFailure with a formatted message.
template <class... Args>
[[noreturn]] void fail_system(fmt::format_string<Args...> format, Args&&... args) {
  throw SystemFailure(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace vinebench::harness
