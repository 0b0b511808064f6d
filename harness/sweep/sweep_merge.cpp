// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/sweep_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/report/metric_table.h"
#include "harness/report/run_folder.h"
#include "harness/run/hash_environment.h"
#include "harness/sets/set_report.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

/// So many are named.
constexpr std::size_t kNamed = 10;

/// Those that are the same wherever a run is made.
std::vector<Metric> metrics_of_estimate() {
  std::vector<Metric> metrics = known_metrics();
  std::erase_if(metrics, [](const Metric& metric) { return !metric.of_estimate; });
  return metrics;
}

/// What tables and checks of medians and repeats are made from: 10,000 whole ones fill the memory.
StoredRun without_details(StoredRun run) {
  std::set<std::string> kept;
  for (const Metric& metric : metrics_of_estimate()) kept.insert(metric.key);
  std::erase_if(run.values, [&](const auto& value) { return !kept.contains(value.first); });
  Json json = Json::object();
  for (const char* key : {"hash", "failure"}) {
    if (run.json.contains(key)) json[key] = run.json[key];
  }
  run.json = std::move(json);
  std::erase_if(run.checks, [](const Check& check) { return check.ok; });
  return run;
}

class Merger {
 public:
  explicit Merger(const std::vector<fs::path>& folders) : folders_(folders) {}

  /// Looks for the run's result in all folders, and takes the first.
  void find(const SweepTask& task, const PlannedRun& run, SetRun& result) {
    for (const fs::path& below : folders_) {
      const fs::path folder = below / task.folder;
      std::optional<StoredRun> here = read(folder, task, run);
      if (!here) continue;
      if (!result.result) {
        result.result = std::move(here);
        result.folder = folder;
      } else if (here->hash() != result.result->hash()) {
        object("{}: another result of the same run than in {}: hash {}, there {}", folder.string(),
               result.folder.string(), here->hash(), result.result->hash());
      }
    }
  }

  void throw_objections() const {
    if (objections_.empty()) return;
    std::string text;
    for (std::size_t i = 0; i < std::min(kNamed, objections_.size()); ++i) {
      text += (i > 0 ? "\n" : "") + objections_[i];
    }
    if (objections_.size() > kNamed) {
      text += fmt::format("\nand {} more", objections_.size() - kNamed);
    }
    fail("{}", text);
  }

 private:
  template <class... Args>
  void object(fmt::format_string<Args...> format, Args&&... args) {
    objections_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  std::optional<StoredRun> read(const fs::path& folder, const SweepTask& task,
                                const PlannedRun& run) {
    std::error_code ignored;
    const fs::path inputs = folder / kInputsFile;
    if (!fs::is_regular_file(inputs, ignored)) return std::nullopt;  // killed before its end
    std::optional<StoredRun> result = read_stored_run(folder / "metrics.json");
    if (!result) return std::nullopt;
    if (read_file(inputs) != task.key + "\n") {
      object("{}: a result of other inputs than the plan's: another build, scenario or file",
             folder.string());
      return std::nullopt;
    }
    if (result->scenario != run.settings->name || result->seed != task.seed) {
      object("{}: expected a result of {}, seed {}, found {}, seed {}", folder.string(),
             run.settings->name, task.seed, result->scenario, result->seed);
      return std::nullopt;
    }
    if (result->hash().empty()) {
      object("{}: metrics.json: has no hash", folder.string());
      return std::nullopt;
    }
    check_environment(folder, run, *result);
    return without_details(*std::move(result));
  }

  /// Results of one renderer are made where all that computes is the same.
  void check_environment(const fs::path& folder, const PlannedRun& run, const StoredRun& result) {
    std::string& renderer = renderers_[run.settings.get()];
    if (renderer.empty()) renderer = format_yaml(run.settings->simulation.renderer);
    const auto [first, is_first] =
        environments_.try_emplace(renderer, result.hash_environment(), folder);
    if (is_first) return;
    const auto& [environment, there] = first->second;
    const std::string names = environment_differences(environment, result.hash_environment());
    if (names.empty()) return;
    object("{}: was made where {} is another than for {}: hashes are not comparable",
           folder.string(), names, there.string());
  }

  const std::vector<fs::path>& folders_;
  std::map<const ScenarioConfig*, std::string> renderers_;  ///< their settings
  /// By the renderer, of the first result, and where that is.
  std::map<std::string, std::pair<NamedValues, fs::path>> environments_;
  std::vector<std::string> objections_;
};

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells)
    line += (&cell == &cells.front() ? "" : ",") + csv_cell(cell);
  return line + "\n";
}

std::set<std::string> grid_keys(const SweepPlan& plan) {
  std::set<std::string> keys;
  for (const SweepCell& cell : plan.cells) {
    for (const auto& [key, value] : cell.point) keys.insert(key);
  }
  return keys;
}

}  // namespace

MergedSweep merge_sweep(const SweepPlan& plan, const std::vector<fs::path>& folders,
                        const ScenarioLoader& load) {
  std::vector<std::size_t> all(plan.tasks.size());
  std::iota(all.begin(), all.end(), 0);
  MergedSweep merged{planned_runs(plan, all, load, folders.front()), {}, {}};
  for (PlannedRun& run : merged.plan) run.folder = fs::path();  // 10,000 paths are 10 MB
  Merger merger(folders);
  for (const std::size_t t : all) {
    const PlannedRun& run = merged.plan[t];
    SetRun result{.scenario = run.title,
                  .seed = run.seed,
                  .folder = {},
                  .repeat = run.repeat,
                  .repeats = run.repeats};
    merger.find(plan.tasks[t], run, result);
    result.missing = !result.result;
    if (result.missing) merged.missing.push_back(t);
    merged.outcome.runs.push_back(std::move(result));
  }
  merger.throw_objections();
  return merged;
}

std::string format_csv(const SweepPlan& plan, const MergedSweep& merged) {
  const std::vector<Metric> metrics = metrics_of_estimate();
  const std::set<std::string> keys = grid_keys(plan);
  std::vector<std::string> cells{"scenario", "system"};
  cells.insert(cells.end(), keys.begin(), keys.end());
  for (const char* name : {"seed", "repeat", "verdict", "hash"}) cells.push_back(name);
  for (const Metric& metric : metrics) cells.push_back(name_of(metric));
  std::string text = csv_line(cells);
  for (std::size_t t = 0; t < plan.tasks.size(); ++t) {
    const SweepCell& cell = plan.cells[plan.tasks[t].cell];
    const SetRun& run = merged.outcome.runs[t];
    cells = {merged.plan[t].settings->name, cell.system};
    for (const std::string& key : keys) {
      const auto value = cell.point.find(key);
      cells.push_back(value != cell.point.end() ? value->second : "");
    }
    cells.push_back(std::to_string(run.seed));
    cells.push_back(std::to_string(run.repeat));
    cells.push_back(verdict_of(run));
    cells.push_back(run.result ? run.result->hash() : "");
    for (const Metric& metric : metrics) {
      const auto value = run.result ? run.result->value(metric.key) : std::nullopt;
      cells.push_back(value ? fmt::format("{}", *value) : "");
    }
    text += csv_line(cells);
  }
  return text;
}

std::string format_missing(const MergedSweep& merged) {
  if (merged.missing.empty()) return "";
  std::string text =
      fmt::format("{} of {} runs are missing:\n", merged.missing.size(), merged.plan.size());
  for (std::size_t i = 0; i < std::min(kNamed, merged.missing.size()); ++i) {
    const PlannedRun& run = merged.plan[merged.missing[i]];
    text += fmt::format("  {}, {}\n", run.title, seed_text(run.seed, run.repeat, run.repeats));
  }
  if (merged.missing.size() > kNamed) {
    text += fmt::format("  and {} more\n", merged.missing.size() - kNamed);
  }
  return text;
}

}  // namespace vinebench::harness
