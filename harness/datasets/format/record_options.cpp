// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/record_options.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

/// An unsigned integer; -1 for other text.
std::int64_t whole_number(std::string_view text) {
  std::int64_t value = -1;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end ? value : -1;
}

}  // namespace

std::string RecordOptions::text() const {
  std::vector<int> ids;
  for (const Category category : categories) ids.push_back(category_id(category));
  return fmt::format("{} | {} | {} {} | {} {} {} | {} {} {}", fmt::join(formats, ","),
                     fmt::join(cameras, ","), fmt::join(ids, ","), least_area, first, last, every,
                     images ? static_cast<int>(*images) : -1, colour, sequence);
}

std::vector<bool> chosen_cameras(const std::vector<std::string>& names, const Rig& rig,
                                 const std::string& what) {
  std::vector<bool> chosen(names.empty() ? 0 : rig.cameras.size(), false);
  for (const std::string& name : names) {
    const int camera = rig.find_camera(name);
    if (camera < 0) fail("{}: rig '{}' has no camera named '{}'", what, rig.name, name);
    chosen[static_cast<std::size_t>(camera)] = true;
  }
  return chosen;
}

std::set<Category> parse_categories(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (std::size_t i = 0; is_thing(static_cast<Category>(i)); ++i) {
    known.emplace_back(category_name(static_cast<Category>(i)));
  }
  std::set<Category> categories;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) {
      fail("--labels: unknown category '{}', expected some of {}", name, fmt::join(known, ", "));
    }
    categories.insert(static_cast<Category>(found - known.begin()));
  }
  return categories;
}

std::pair<std::int64_t, std::int64_t> parse_span(const std::string& text, const std::string& what) {
  const std::size_t dots = text.find("..");
  const std::string_view whole = text;
  const std::int64_t first = whole_number(whole.substr(0, dots));
  const std::int64_t last =
      dots == std::string::npos ? first : whole_number(whole.substr(dots + 2));
  if (first < 0 || last < first) {
    fail("{} {}: expected A..B with whole numbers, A at most B, such as 1..20", what, text);
  }
  return {first, last};
}

}  // namespace vinebench::harness
