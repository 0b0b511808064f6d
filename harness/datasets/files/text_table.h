// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/time.h"

namespace vinebench::harness {

/// One line of a text file of columns, with what it takes to say where a fault is.
struct TableRow {
  std::filesystem::path file;
  int line = 0;
  std::vector<std::string> fields;

  /// Throws Error that names file and line.
  [[noreturn]] void fault(const std::string& message) const;
  void expect_columns(std::size_t at_least, const std::string& names) const;
  double number(std::size_t column) const;
  Stamp nanoseconds(std::size_t column) const;
};

/// Reads a file of columns separated by commas, blanks or tabs. Empty lines and lines that begin
/// with '#' are left out; so are carriage returns. Throws Error when the file cannot be read.
std::vector<TableRow> read_rows(const std::filesystem::path& file);

/// The same, without a first line that begins with no number: a header.
std::vector<TableRow> read_table(const std::filesystem::path& file);

/// Whether the text is a finite number, all of it.
bool is_number(const std::string& text);

}  // namespace vinebench::harness
