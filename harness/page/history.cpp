// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/history.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/util/error.h"
#include "core/util/percentile.h"
#include "harness/comparison/paired_runs.h"
#include "harness/statistics/distributions.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLeastVersions = 3;
constexpr double kInside = 0.995;  // quantile of each side
constexpr double kLeastSpread = 0.01;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

struct Version {
  std::string name;
  /// Medians by scenario, in the order of known_metrics().
  std::map<std::string, std::vector<std::optional<double>>> medians;
};

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> folders;
  fs::directory_iterator entry(folder, error);
  if (error) fail("{}: expected a folder of versions: {}", folder.string(), error.message());
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (entry->is_directory()) folders.push_back(entry->path());
  }
  std::ranges::sort(folders, [](const fs::path& a, const fs::path& b) {
    return in_natural_order(a.filename().string(), b.filename().string());
  });
  return folders;
}

Version version_of(const fs::path& folder) {
  Version version{folder.filename().string(), {}};
  std::map<std::string, std::vector<SeedRuns>> scenarios;
  for (SeedRuns& runs : find_runs(folder)) scenarios[runs.scenario].push_back(std::move(runs));
  for (const auto& [scenario, seeds] : scenarios) {
    for (const Metric& metric : known_metrics()) {
      std::vector<double> values;
      for (const SeedRuns& seed : seeds) {
        if (const auto value = value_of(metric, seed)) values.push_back(*value);
      }
      // Of passing the share is of interest, not the median.
      double sum = 0;
      for (const double value : values) sum += value;
      std::optional<double> figure;
      if (!values.empty()) {
        figure = metric.key == kPassedKey ? sum / static_cast<double>(values.size())
                                          : percentile(values, 0.5);
      }
      version.medians[scenario].push_back(figure);
    }
  }
  return version;
}

const char* change_of(const Metric& metric, const std::optional<Band>& band, double newest) {
  if (!band) return "unknown";
  if (band->contains(newest)) return "inside";
  return (newest > band->high) == metric.larger_is_better ? "better" : "worse";
}

Json series_json(const std::vector<Version>& versions, const std::string& scenario,
                 std::size_t index) {
  const Metric& metric = known_metrics().at(index);
  Json values = Json::array();
  std::vector<double> known;
  for (const Version& version : versions) {
    const auto found = version.medians.find(scenario);
    const auto value = found == version.medians.end() ? std::nullopt : found->second.at(index);
    values.push_back(value ? Json(*value) : Json());
    if (value) known.push_back(*value);
  }
  Json series{{"scenario", scenario},
              {"metric", name_of(metric)},
              {"title", metric.title},
              {"decimals", metric.decimals},
              {"values", values}};
  if (values.empty() || values.back().is_null()) {
    series["change"] = "absent";
    return series;
  }
  const double newest = known.back();
  known.pop_back();
  const std::optional<Band> band = band_of(metric, known);
  if (band) series["band"] = {band->low, band->high};
  series["change"] = change_of(metric, band, newest);
  return series;
}

}  // namespace

std::optional<Band> band_of(const Metric& metric, const std::vector<double>& earlier) {
  if (earlier.size() < kLeastVersions) return std::nullopt;
  const bool logarithms = metric.compared_by == Scale::kRatio &&
                          std::ranges::all_of(earlier, [](double value) { return value > 0; });
  const auto n = static_cast<double>(earlier.size());
  double mean = 0, squares = 0;
  for (const double value : earlier) mean += (logarithms ? std::log(value) : value) / n;
  for (const double value : earlier) {
    squares += std::pow((logarithms ? std::log(value) : value) - mean, 2);
  }
  const double least =
      logarithms ? kLeastSpread : std::max(metric.tolerance, kLeastSpread * std::abs(mean));
  const double spread = std::max(std::sqrt(squares / (n - 1)), least);
  const double half = student_t_quantile(kInside, n - 1) * spread * std::sqrt(1 + 1 / n);
  if (logarithms) return Band{std::exp(mean - half), std::exp(mean + half)};
  return Band{mean - half, mean + half};
}

bool in_natural_order(const std::string& a, const std::string& b) {
  std::size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i, ++k;
      continue;
    }
    const auto number = [](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(begin, at - begin);
    };
    const std::string one = number(a, i), other = number(b, k);
    if (one.size() != other.size()) return one.size() < other.size();
    if (one != other) return one < other;
  }
  return a.size() - i < b.size() - k;
}

Json history_json(const fs::path& folder) {
  std::vector<Version> versions;
  for (const fs::path& version : folders_in(folder)) versions.push_back(version_of(version));
  if (versions.empty()) {
    fail("{}: contains no folder; expected one for each version", folder.string());
  }
  std::set<std::string> scenarios;
  Json names = Json::array(), series = Json::array();
  for (const Version& version : versions) {
    names.push_back(version.name);
    for (const auto& [scenario, medians] : version.medians) scenarios.insert(scenario);
  }
  for (const std::string& scenario : scenarios) {
    for (std::size_t i = 0; i < known_metrics().size(); ++i) {
      series.push_back(series_json(versions, scenario, i));
    }
  }
  return {{"versions", names}, {"series", series}};
}

}  // namespace vinebench::harness
