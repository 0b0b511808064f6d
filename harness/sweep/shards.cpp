// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/shards.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr int kMostShards = 100000;

bool parse_number(std::string_view text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  const std::size_t slash = text.find('/');
  const bool parsed = slash != std::string::npos &&
                      parse_number(std::string_view(text).substr(0, slash), shard.index) &&
                      parse_number(std::string_view(text).substr(slash + 1), shard.count);
  const bool ok = parsed && shard.count >= 1 && shard.count <= kMostShards && shard.index >= 1 &&
                  shard.index <= shard.count;
  if (!ok) fail("'{}': expected I/N, such as 3/16, with I from 1 to N", text);
  return shard;
}

std::vector<std::size_t> tasks_of(const Shard& shard, const std::vector<double>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  using Load = std::pair<double, int>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int i = 1; i <= shard.count; ++i) loads.emplace(0, i);
  std::vector<std::size_t> tasks;
  for (const std::size_t task : order) {
    auto [load, index] = loads.top();
    loads.pop();
    if (index == shard.index) tasks.push_back(task);
    loads.emplace(load + costs[task], index);
  }
  return tasks;
}

}  // namespace vinebench::harness
