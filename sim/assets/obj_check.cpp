// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/obj_check.h"

#include <functional>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr std::string_view kLineEnds = "\r\n\f";  // assimp's
constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kMostItems = 10'000'000;

void check_text(std::string_view text, const std::string& file) {
  const bool wide = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
  if (wide || text.find('\0') != text.npos) {
    fail("{}: expected text in UTF-8, found UTF-16 or no text", file);
  }
}

/// Calls `take` with each line that is not blank, without leading blanks, and its number.
void for_each_line(std::string_view text,
                   const std::function<void(std::string_view line, int number)>& take) {
  int number = 1;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(kLineEnds, begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    if (!line.empty()) take(line, number);
    if (end < text.size() && text[end] == '\n') ++number;
    begin = end + 1;
  }
}

std::string_view first_word(std::string_view line) {
  return line.substr(0, line.find_first_of(kBlanks));
}

std::size_t count_words(std::string_view line) {
  std::size_t words = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const bool blank = kBlanks.find(line[at]) != kBlanks.npos;
    words += !blank && (at == 0 || kBlanks.find(line[at - 1]) != kBlanks.npos) ? 1 : 0;
  }
  return words;
}

}  // namespace

void check_obj(std::string_view text, const std::string& file) {
  check_text(text, file);
  std::size_t vertices = 0, corners = 0;
  for_each_line(text, [&](std::string_view line, int number) {
    const std::string_view word = first_word(line);
    // assimp reads beyond the end of a name that ends so.
    if (word == "mtllib" && line.find("://") != line.npos) {
      fail("{}:{}: mtllib: expected a file beside the mesh, found a URL", file, number);
    }
    if (word == "v") ++vertices;
    if (word == "f" || word == "l" || word == "p") corners += count_words(line) - 1;
  });
  if (vertices > kMostItems || corners > kMostItems) {
    fail("{}: expected at most {} vertices and corners of faces, found {} and {}", file, kMostItems,
         vertices, corners);
  }
}

void check_mtl(std::string_view text, const std::string& file) {
  check_text(text, file);
  bool named = false;
  for_each_line(text, [&](std::string_view line, int number) {
    named = named || first_word(line) == "newmtl";
    if (named || line.starts_with('#')) return;
    fail("{}:{}: expected 'newmtl' before the first property, found '{}'", file, number,
         first_word(line).substr(0, 40));
  });
}

}  // namespace vinebench::sim
