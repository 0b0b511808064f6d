// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/time.h"

namespace vinebench::harness {

/// One line of a text file of columns, with its position for error messages.
struct TableRow {
  std::filesystem::path file;
  int line = 0;
  std::vector<std::string> fields;

  /// Throws Error that names file and line.
  [[noreturn]] void fault(const std::string& message) const;
  void expect_columns(std::size_t at_least, const std::string& names) const;
  double number(std::size_t column) const;
  Stamp nanoseconds(std::size_t column) const;
  /// A time in seconds, as parse_seconds().
  Stamp seconds(std::size_t column) const;
};

/// Reads a file of columns separated by commas, blanks or tabs. Empty lines, lines that begin with
/// '#' and carriage returns are ignored. Throws Error if the file cannot be read.
std::vector<TableRow> read_rows(const std::filesystem::path& file);

/// Only lines that end: one that an interruption cut off is ignored.
std::vector<TableRow> read_ended_rows(const std::filesystem::path& file);

/// The rows of read_rows(), without a header: a first line that does not begin with a number.
std::vector<TableRow> read_table(const std::filesystem::path& file);

/// Whether the whole text is a finite number.
bool is_number(const std::string& text);

}  // namespace vinebench::harness
