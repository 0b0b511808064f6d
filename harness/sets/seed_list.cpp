// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/seed_list.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::int64_t kMost = 10'000;

std::int64_t parse_seed(const std::string& text, const std::string& whole) {
  std::int64_t seed = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc{} || end != text.data() + text.size() || seed < 0) {
    fail("seeds '{}': expected whole numbers such as 1..5 or 1,4,7, found '{}'", whole, text);
  }
  return seed;
}

}  // namespace

std::vector<std::int64_t> parse_seeds(const std::string& text) {
  std::vector<std::int64_t> seeds;
  std::istringstream in(text + ",");  // so that a trailing comma gives an empty part
  for (std::string part; std::getline(in, part, ',');) {
    const std::size_t dots = part.find("..");
    const std::int64_t first = parse_seed(part.substr(0, dots), text);
    const std::int64_t last =
        dots == std::string::npos ? first : parse_seed(part.substr(dots + 2), text);
    if (last < first) fail("seeds '{}': {} runs backwards", text, part);
    if (last - first >= kMost) fail("seeds '{}': expected at most {}", text, kMost);
    for (std::int64_t seed = first; seed <= last; ++seed) {
      if (std::ranges::count(seeds, seed) > 0) fail("seeds '{}': {} is repeated", text, seed);
      seeds.push_back(seed);
    }
  }
  if (seeds.size() > kMost) fail("seeds '{}': expected at most {}", text, kMost);
  return seeds;
}

}  // namespace vinebench::harness
