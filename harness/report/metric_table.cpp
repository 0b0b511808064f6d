// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/metric_table.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/util/error.h"
#include "core/util/suggestion.h"

namespace vinebench::harness {
namespace {

/// Width in characters: the dash has several bytes.
constexpr const char* kNothing = "–";

std::size_t places(const std::string& cell) {
  return static_cast<std::size_t>(
      std::ranges::count_if(cell, [](unsigned char byte) { return (byte & 0xC0) != 0x80; }));
}

}  // namespace

const std::vector<Metric>& shown_metrics() {
  static const std::vector<Metric> list{
      {.key = "/ate_origin_rmse_m", .title = "ATE origin, mm", .scale = 1e3, .decimals = 2},
      {.key = "/ate_rmse_m", .title = "ATE, mm", .scale = 1e3, .decimals = 2},
      {.key = "/rpe_trans_percent", .title = "RPE, %", .decimals = 3},
      {.key = "/coverage",
       .title = "coverage, %",
       .scale = 100,
       .decimals = 2,
       .larger_is_better = true,
       .compared_by = Scale::kOrdered,
       .tolerance = 0.5},
      {.key = "/losses", .title = "losses", .compared_by = Scale::kOrdered},
      {.key = "/loop_closures/correct",
       .title = "loops right",
       .larger_is_better = true,
       .compared_by = Scale::kOrdered},
      {.key = "/loop_closures/wrong", .title = "loops wrong", .compared_by = Scale::kOrdered},
      {.key = "/loop_closures/missed", .title = "loops missed", .compared_by = Scale::kOrdered},
      {.key = "/real_time_factor",
       .title = "real time",
       .decimals = 3,
       .larger_is_better = true,
       .of_estimate = false},
      {.key = "/cpu_seconds", .title = "CPU, s", .decimals = 1, .of_estimate = false},
  };
  return list;
}

const std::vector<Metric>& known_metrics() {
  static const std::vector<Metric> list = [] {
    std::vector<Metric> all{{.key = kPassedKey,
                             .title = "passed, %",
                             .scale = 100,
                             .larger_is_better = true,
                             .compared_by = Scale::kOrdered}};
    all.insert(all.end(), shown_metrics().begin(), shown_metrics().end());
    const std::vector<Metric> others{
        {.key = "/ate_max_m", .title = "ATE max, mm", .scale = 1e3, .decimals = 2},
        {.key = "/ate_live_rmse_m", .title = "ATE live, mm", .scale = 1e3, .decimals = 2},
        {.key = "/ate_world_rmse_m", .title = "ATE, world, mm", .scale = 1e3, .decimals = 2},
        {.key = "/ate_world_live_rmse_m",
         .title = "ATE, world, live, mm",
         .scale = 1e3,
         .decimals = 2},
        {.key = "/ate_world_p95_m", .title = "95 %, world, mm", .scale = 1e3, .decimals = 2},
        {.key = "/end_error_m", .title = "end error, mm", .scale = 1e3, .decimals = 1},
        {.key = "/lost_frames", .title = "lost frames", .compared_by = Scale::kOrdered},
        {.key = "/wall_seconds", .title = "wall, s", .decimals = 1, .of_estimate = false},
        {.key = "/peak_rss_mib", .title = "memory, MiB", .of_estimate = false}};
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }();
  return list;
}

std::string name_of(const Metric& metric) {
  std::string name = metric.key.substr(1);
  std::ranges::replace(name, '/', '.');
  return name;
}

const Metric& metric_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Metric& metric : known_metrics()) {
    if (name_of(metric) == name) return metric;
    names.push_back(name_of(metric));
  }
  fail("metric '{}': expected one of {}{}", name, fmt::join(names, ", "),
       did_you_mean(name, names));
}

std::optional<double> value_of(const Metric& metric, const StoredRun& run) {
  const std::optional<double> value = run.value(metric.key);
  return value ? std::optional(metric.scale * *value) : std::nullopt;
}

std::string format_value(const Metric& metric, const std::optional<double>& value) {
  return value ? fmt::format("{:.{}f}", *value, metric.decimals) : kNothing;
}

std::string markdown_table(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], places(row[i]));
  }
  std::string text;
  for (std::size_t line = 0; line < rows.size(); ++line) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += i < left ? fmt::format("| {:<{}} ", rows[line][i], widths[i])
                       : fmt::format("| {:>{}} ", rows[line][i], widths[i]);
    }
    text += "|\n";
    if (line > 0) continue;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += fmt::format("|{:-<{}}", "", widths[i] + 1) + (i < left ? "-" : ":");
    }
    text += "|\n";
  }
  return text;
}

}  // namespace vinebench::harness
