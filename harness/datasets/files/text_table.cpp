// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/text_table.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr const char* kBlank = " \t\r";

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Splits at commas if there are any, otherwise at blanks. A trailing comma adds no field.
std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  if (line.find(',') == std::string::npos) {
    for (std::string word; in >> word;) fields.push_back(word);
    return fields;
  }
  for (std::string field; std::getline(in, field, ',');) fields.push_back(trimmed(field));
  return fields;
}

/// Also "nan" and "inf", which are no headers.
std::optional<double> numeral(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

std::vector<TableRow> rows_of(const std::filesystem::path& file, const std::string& text) {
  std::istringstream in(text);
  std::vector<TableRow> rows;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    TableRow row{file, number, split_fields(line)};
    if (!row.fields.empty()) rows.push_back(std::move(row));  // other kinds of blanks alone
  }
  return rows;
}

}  // namespace

bool is_number(const std::string& text) {
  const std::optional<double> value = numeral(text);
  return value && std::isfinite(*value);
}

void TableRow::fault(const std::string& message) const {
  fail("{}:{}: {}", file.string(), line, message);
}

void TableRow::expect_columns(std::size_t at_least, const std::string& names) const {
  if (fields.size() >= at_least) return;
  fault(fmt::format("expected {} columns ({}), found {}", at_least, names, fields.size()));
}

double TableRow::number(std::size_t column) const {
  const std::string& text = fields.at(column);
  if (!is_number(text)) fault(fmt::format("expected a number, found '{}'", text));
  return std::strtod(text.c_str(), nullptr);
}

Stamp TableRow::nanoseconds(std::size_t column) const {
  const std::string& text = fields.at(column);
  Stamp stamp = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stamp);
  if (error != std::errc{} || end != text.data() + text.size() || !is_in_range(stamp)) {
    fault(fmt::format("expected a whole number of nanoseconds, found '{}'", text));
  }
  return stamp;
}

Stamp TableRow::seconds(std::size_t column) const {
  try {
    return parse_seconds(fields.at(column));
  } catch (const Error& error) {
    fault(error.what());
  }
}

std::vector<TableRow> read_rows(const std::filesystem::path& file) {
  return rows_of(file, read_file(file, FileKind::kTable));
}

std::vector<TableRow> read_ended_rows(const std::filesystem::path& file) {
  const std::string text = read_file(file, FileKind::kTable);
  return rows_of(file, text.substr(0, text.rfind('\n') + 1));
}

std::vector<TableRow> read_table(const std::filesystem::path& file) {
  std::vector<TableRow> rows = read_rows(file);
  if (!rows.empty() && !numeral(rows.front().fields.front())) rows.erase(rows.begin());
  return rows;
}

}  // namespace vinebench::harness
