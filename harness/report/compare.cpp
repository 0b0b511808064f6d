// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/compare.h"

#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

using RunName = std::pair<std::string, std::int64_t>;  ///< scenario and seed

std::string text_of(const RunName& name) {
  return fmt::format("{}, seed {}", name.first, name.second);
}

struct FoundRun {
  StoredRun run;
  fs::path folder;
};

std::map<RunName, FoundRun> find_runs(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) fail("{}: expected a folder of runs", folder.string());
  std::map<RunName, FoundRun> runs;
  const auto options = fs::directory_options::skip_permission_denied;
  fs::recursive_directory_iterator entry(folder, options, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const fs::path file = entry->path();
    if (file.filename() != "metrics.json") continue;
    std::optional<StoredRun> run = read_stored_run(file);
    if (!run) fail("{}: is not a metrics.json of a run", file.string());
    const RunName name{run->scenario, run->seed};
    const fs::path place = file.parent_path();
    if (const auto other = runs.find(name); other != runs.end()) {
      const auto [first, second] = std::minmax(other->second.folder, place);
      fail("{}: {} is duplicate, in {} and {}", folder.string(), text_of(name), first.string(),
           second.string());
    }
    runs.emplace(name, FoundRun{std::move(*run), place});
  }
  if (error) fail("{}: cannot be read: {}", folder.string(), error.message());
  if (runs.empty()) {
    fail("{}: contains no run; expected a metrics.json in it or in its folders", folder.string());
  }
  return runs;
}

/// The number of frames of both where it differs.
std::string different_length(const StoredRun& before, const StoredRun& after) {
  const auto a = before.value("/frames");
  const auto b = after.value("/frames");
  if (!a || !b || *a == *b) return "";
  return fmt::format("A has {:.0f} frames, B has {:.0f}", *a, *b);
}

/// Files are compared by their names, because their folders may differ.
std::string comparable(const YAML::Node& node) {
  if (node.IsScalar() && node.Scalar().find('/') != std::string::npos) {
    return fs::path(node.Scalar()).filename().string();
  }
  return YAML::Dump(node);
}

/// Keys that are in both and differ, as `world.sun.elevation_deg`.
void add_differences(const YAML::Node& before, const YAML::Node& after, const std::string& key,
                     std::vector<std::string>& keys) {
  if (!before.IsMap() || !after.IsMap()) {
    if (comparable(before) != comparable(after)) keys.push_back(key);
    return;
  }
  for (const auto& item : before) {
    const auto name = item.first.as<std::string>();
    const YAML::Node other = after[name];
    if (!other) continue;
    add_differences(item.second, other, key.empty() ? name : key + "." + name, keys);
  }
}

/// The experiment of a run, without what a comparison is about; null if it has no such file.
YAML::Node experiment_of(const fs::path& folder) {
  std::error_code ignored;
  const fs::path file = folder / "scenario.resolved.yaml";
  if (!fs::is_regular_file(file, ignored)) return {};
  try {
    YAML::Node experiment = YAML::Load(read_file(file));
    for (const char* other : {"slam", "expectations", "goal", "guard", "description"}) {
      if (experiment.IsMap()) experiment.remove(other);
    }
    return experiment;
  } catch (const YAML::Exception& error) {
    fail("{}: is not valid YAML: {}", file.string(), error.what());
  }
}

/// What the experiments of two runs differ in, human-readable; empty if nothing is known to differ.
std::string differing_keys(const fs::path& before, const fs::path& after) {
  constexpr std::size_t kShown = 5;
  std::vector<std::string> keys;
  const YAML::Node first = experiment_of(before);
  const YAML::Node second = experiment_of(after);
  if (first.IsMap() && second.IsMap()) add_differences(first, second, "", keys);
  if (keys.empty()) return "";
  const std::size_t shown = std::min(keys.size(), kShown);
  std::string text = fmt::format("{}", fmt::join(keys.begin(), keys.begin() + shown, ", "));
  if (shown < keys.size()) text += fmt::format(" and {} more", keys.size() - shown);
  return text;
}

MetricChange change_of(const Metric& metric, const std::vector<RunPair>& pairs) {
  MetricChange change{.metric = metric};
  for (const RunPair& pair : pairs) {
    const auto before = value_of(metric, pair.before);
    const auto after = value_of(metric, pair.after);
    if (!before || !after) continue;
    change.before += *before;
    change.after += *after;
    change.differences.push_back(*after - *before);
  }
  change.pairs = change.differences.size();
  if (change.pairs == 0) return change;
  const double n = static_cast<double>(change.pairs);
  change.before /= n;
  change.after /= n;
  const double mean =
      std::accumulate(change.differences.begin(), change.differences.end(), 0.0) / n;
  if (change.pairs > 1) {
    double squares = 0;
    for (const double d : change.differences) squares += (d - mean) * (d - mean);
    change.half_width = student_t_95(change.pairs - 1) * std::sqrt(squares / (n - 1) / n);
  }
  const bool equal = std::ranges::all_of(change.differences, [](double d) { return d == 0; });
  if (equal || (change.half_width && std::abs(mean) <= *change.half_width)) {
    change.change = Change::kSame;
  } else if (change.half_width) {
    change.change = (mean > 0) == metric.larger_is_better ? Change::kBetter : Change::kWorse;
  }
  return change;
}

/// Pairs by scenario; then all together if there are several.
std::vector<std::pair<std::string, std::vector<RunPair>>> groups_of(const PairedRuns& runs) {
  std::vector<std::pair<std::string, std::vector<RunPair>>> groups;
  for (const RunPair& pair : runs.pairs) {
    if (groups.empty() || groups.back().first != pair.before.scenario) {
      groups.push_back({pair.before.scenario, {}});
    }
    groups.back().second.push_back(pair);
  }
  if (groups.size() > 1) groups.push_back({"all scenarios", runs.pairs});
  return groups;
}

std::string interval_text(const MetricChange& change) {
  if (!change.half_width) return "one pair";
  const double mean = change.difference();
  return fmt::format("{:+.{}f} .. {:+.{}f}", mean - *change.half_width, change.metric.decimals + 1,
                     mean + *change.half_width, change.metric.decimals + 1);
}

std::string table_of(const std::vector<MetricChange>& changes) {
  std::vector<std::vector<std::string>> rows{
      {"figure", "pairs", "A", "B", "B - A", "95 % interval", "verdict"}};
  for (const MetricChange& change : changes) {
    rows.push_back({change.metric.title, std::to_string(change.pairs),
                    format_value(change.metric, change.before),
                    format_value(change.metric, change.after),
                    fmt::format("{:+.{}f}", change.difference(), change.metric.decimals + 1),
                    interval_text(change), name_of(change.change)});
  }
  return markdown_table(rows, 1);
}

}  // namespace

PairedRuns pair_runs(const fs::path& before, const fs::path& after) {
  const std::map<RunName, FoundRun> first = find_runs(before);
  const std::map<RunName, FoundRun> second = find_runs(after);
  PairedRuns runs;
  std::string length;
  for (const auto& [name, found] : first) {
    const auto partner = second.find(name);
    if (partner == second.end()) {
      runs.unpaired.push_back(fmt::format("{} (only in {})", text_of(name), before.string()));
      continue;
    }
    const auto& [run, folder] = partner->second;
    if (const std::string lengths = different_length(found.run, run); !lengths.empty()) {
      length = fmt::format("{} ({})", text_of(name), lengths);
      runs.unpaired.push_back(length);
      continue;
    }
    runs.pairs.push_back({found.run, run});
    const std::string keys = differing_keys(found.folder, folder);
    if (!keys.empty()) runs.differing.push_back(fmt::format("{}: {}", text_of(name), keys));
  }
  for (const auto& [name, run] : second) {
    if (first.contains(name)) continue;
    runs.unpaired.push_back(fmt::format("{} (only in {})", text_of(name), after.string()));
  }
  if (!runs.pairs.empty()) return runs;
  if (!length.empty()) fail("no two runs are of the same length: {}", length);
  fail("no scenario and seed is in both folders: {} has {}, {} has {}", before.string(),
       text_of(first.begin()->first), after.string(), text_of(second.begin()->first));
}

const char* name_of(Change change) {
  switch (change) {
    case Change::kBetter:
      return "better";
    case Change::kSame:
      return "same";
    case Change::kWorse:
      return "worse";
    case Change::kMixed:
      return "mixed";
    case Change::kUnknown:
      return "unknown";
  }
  return "";
}

std::vector<MetricChange> compare_metrics(const std::vector<RunPair>& pairs) {
  std::vector<MetricChange> changes;
  for (const Metric& metric : shown_metrics()) {
    MetricChange change = change_of(metric, pairs);
    if (change.pairs > 0) changes.push_back(std::move(change));
  }
  return changes;
}

Change overall(const std::vector<MetricChange>& changes) {
  const auto any = [&](Change change) {
    return std::ranges::any_of(changes, [&](const MetricChange& one) {
      return one.metric.of_estimate && one.change == change;
    });
  };
  if (any(Change::kBetter) && any(Change::kWorse)) return Change::kMixed;
  if (any(Change::kBetter)) return Change::kBetter;
  if (any(Change::kWorse)) return Change::kWorse;
  return any(Change::kUnknown) ? Change::kUnknown : Change::kSame;
}

std::string format_comparison(const PairedRuns& runs) {
  std::string text;
  for (const auto& [name, pairs] : groups_of(runs)) {
    const std::vector<MetricChange> changes = compare_metrics(pairs);
    text += fmt::format("\n{}: B is {} (of its estimate; by {} {})\n\n{}", name,
                        name_of(overall(changes)), pairs.size(),
                        pairs.size() == 1 ? "pair, which gives no interval" : "pairs",
                        table_of(changes));
  }
  for (const std::string& run : runs.unpaired) text += fmt::format("not compared: {}\n", run);
  for (const std::string& run : runs.differing) {
    text += fmt::format("warning: not the same experiment: {}\n", run);
  }
  return text;
}

Json comparison_json(const PairedRuns& runs) {
  Json groups = Json::array();
  for (const auto& [name, pairs] : groups_of(runs)) {
    const std::vector<MetricChange> changes = compare_metrics(pairs);
    Json list = Json::array();
    for (const MetricChange& change : changes) {
      list.push_back({{"figure", change.metric.title},
                      {"pairs", change.pairs},
                      {"a", change.before},
                      {"b", change.after},
                      {"difference", change.difference()},
                      {"half_width_95", change.half_width ? Json(*change.half_width) : Json()},
                      {"differences", change.differences},
                      {"verdict", name_of(change.change)}});
    }
    Json seeds = Json::array();
    for (const RunPair& pair : pairs) {
      seeds.push_back({{"scenario", pair.before.scenario}, {"seed", pair.before.seed}});
    }
    groups.push_back({{"name", name},
                      {"verdict", name_of(overall(changes))},
                      {"pairs", seeds},
                      {"figures", list}});
  }
  return {{"groups", groups}, {"not_compared", runs.unpaired}, {"differing", runs.differing}};
}

double student_t_95(std::size_t degrees_of_freedom) {
  constexpr std::array<double, 30> kTable{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                          2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                          2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                          2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  if (degrees_of_freedom <= kTable.size()) return kTable[degrees_of_freedom - 1];
  constexpr double z = 1.959964;
  const double n = static_cast<double>(degrees_of_freedom);
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n);
}

}  // namespace vinebench::harness
