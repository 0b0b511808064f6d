// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace vinebench {

/// Throws the exception that is being handled again: as an Error that begins with `where` if it
/// tells of the input or the environment (no memory, the file system, OpenCV, YAML), else as it is,
/// because it is an error of the program.
[[noreturn]] void rethrow_as_error(const std::string& where);

/// The result of `work`, whose exceptions of libraries become an Error that begins with `where`.
template <class Work>
auto with_errors_of(const std::string& where, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const std::exception&) {
    rethrow_as_error(where);
  }
}

}  // namespace vinebench
