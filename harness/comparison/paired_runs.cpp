// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/paired_runs.h"

#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/report/run_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

using RunName = std::pair<std::string, std::int64_t>;  ///< scenario and seed

std::string text_of(const RunName& name) {
  return fmt::format("{}, seed {}", name.first, name.second);
}

/// The number of a folder `repeat-<r>`, 1 of any other.
int repeat_of(const fs::path& folder) {
  const std::string name = folder.filename().string();
  const std::string prefix = kRepeatFolder;
  int number = 1;
  if (name.starts_with(prefix)) {
    std::from_chars(name.data() + prefix.size(), name.data() + name.size(), number);
  }
  return std::max(number, 1);
}

/// The folder of the first repeat.
fs::path base_of(const fs::path& folder) {
  return repeat_of(folder) > 1 ? folder.parent_path() : folder;
}

using Repeats = std::map<int, std::pair<fs::path, StoredRun>>;

void add_run(const fs::path& root, const fs::path& file, std::map<RunName, Repeats>& found) {
  std::optional<StoredRun> run = read_stored_run(file);
  if (!run) fail("{}: is not a metrics.json of a run", file.string());
  const RunName name{run->scenario, run->seed};
  const fs::path folder = file.parent_path();
  Repeats& repeats = found[name];
  const int number = repeat_of(folder);
  for (const auto& [other, place] : repeats) {
    if (other != number && base_of(place.first) == base_of(folder)) continue;
    const auto [first, second] = std::minmax(place.first, folder);
    fail("{}: {} is duplicate, in {} and {}", root.string(), text_of(name), first.string(),
         second.string());
  }
  repeats.emplace(number, std::pair(folder, std::move(*run)));
}

/// The number of frames of both where it differs, of runs whose system did not fail.
std::string different_length(const SeedRuns& before, const SeedRuns& after) {
  const auto lengths = [](const SeedRuns& runs) {
    std::set<double> frames;
    for (const StoredRun& run : runs.repeats) {
      const auto count = run.value("/frames");
      if (count && !run.json.contains("failure")) frames.insert(*count);
    }
    return frames;
  };
  const std::set<double> a = lengths(before);
  const std::set<double> b = lengths(after);
  if (a.empty() || b.empty() || a == b) return "";
  return fmt::format("A has {:.0f} frames, B has {:.0f}", fmt::join(a, " or "),
                     fmt::join(b, " or "));
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

RunName run_name(const SeedRuns& runs) {
  return {runs.scenario, runs.seed};
}

/// Tests by more and less hold if both sides have as many repeats.
void level_repeats(RunPair& pair, std::vector<std::string>& unpaired) {
  const std::size_t a = pair.before.repeats.size();
  const std::size_t b = pair.after.repeats.size();
  if (a == b) return;
  unpaired.push_back(fmt::format("{}: {} of the {} repeats in {}", text_of(run_name(pair.before)),
                                 std::max(a, b) - std::min(a, b), std::max(a, b),
                                 (a > b ? pair.before : pair.after).folder.string()));
  pair.before.repeats.resize(std::min(a, b));
  pair.after.repeats.resize(std::min(a, b));
}

}  // namespace

std::optional<double> value_of(const Metric& metric, const SeedRuns& runs) {
  std::vector<double> values;
  for (const StoredRun& run : runs.repeats) {
    if (run.json.contains("failure") && metric.key != kPassedKey) continue;
    if (const auto value = value_of(metric, run)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  if (values.size() == 1) return values.front();
  const bool ratio = metric.compared_by == Scale::kRatio &&
                     std::ranges::all_of(values, [](double value) { return value > 0; });
  double sum = 0;
  for (const double value : values) sum += ratio ? std::log(value) : value;
  const double mean = sum / static_cast<double>(values.size());
  return ratio ? std::exp(mean) : mean;
}

std::vector<SeedRuns> find_runs(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) fail("{}: expected a folder of runs", folder.string());
  std::map<RunName, Repeats> found;
  const auto options = fs::directory_options::skip_permission_denied;
  fs::recursive_directory_iterator entry(folder, options, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->path().filename() == "metrics.json") add_run(folder, entry->path(), found);
  }
  if (error) fail("{}: cannot be read: {}", folder.string(), error.message());
  if (found.empty()) {
    fail("{}: contains no run; expected a metrics.json in it or in its folders", folder.string());
  }
  std::vector<SeedRuns> runs;
  for (auto& [name, repeats] : found) {
    SeedRuns seed{name.first, name.second, {}, repeats.begin()->second.first};
    for (auto& [number, run] : repeats) seed.repeats.push_back(std::move(run.second));
    runs.push_back(std::move(seed));
  }
  return runs;
}

PairedRuns pair_runs(const fs::path& before, const fs::path& after) {
  const std::vector<SeedRuns> first = find_runs(before);
  const std::vector<SeedRuns> second = find_runs(after);
  PairedRuns runs;
  std::string length;
  for (const SeedRuns& found : first) {
    const std::string name = text_of(run_name(found));
    const auto partner = std::ranges::find(second, run_name(found), run_name);
    if (partner == second.end()) {
      runs.unpaired.push_back(fmt::format("{} (only in {})", name, before.string()));
      continue;
    }
    if (const std::string lengths = different_length(found, *partner); !lengths.empty()) {
      length = fmt::format("{} ({})", name, lengths);
      runs.unpaired.push_back(length);
      continue;
    }
    runs.pairs.push_back({found, *partner});
    level_repeats(runs.pairs.back(), runs.unpaired);
    const std::string keys = differing_keys(found.folder, partner->folder);
    if (!keys.empty()) runs.differing.push_back(fmt::format("{}: {}", name, keys));
  }
  for (const SeedRuns& found : second) {
    if (std::ranges::count(first, run_name(found), run_name) > 0) continue;
    runs.unpaired.push_back(
        fmt::format("{} (only in {})", text_of(run_name(found)), after.string()));
  }
  if (!runs.pairs.empty()) return runs;
  if (!length.empty()) fail("no two runs are of the same length: {}", length);
  fail("no scenario and seed is in both folders: {} has {}, {} has {}", before.string(),
       text_of(run_name(first.front())), after.string(), text_of(run_name(second.front())));
}

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

}  // namespace vinebench::harness
