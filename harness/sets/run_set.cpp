// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/run_set.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/files/output_file.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/jobs/run_scenario.h"
#include "harness/report/run_folder.h"
#include "harness/run/hash_environment.h"
#include "harness/sets/child_process.h"
#include "harness/sets/run_inputs.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

std::string name_of(const PlannedRun& run) {
  return fmt::format("{}, {}", run.title, seed_text(run.seed, run.repeat, run.repeats));
}

bool has_inputs(const fs::path& folder, const std::string& fingerprint) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kInputsFile, ignored) &&
         read_file(folder / kInputsFile) == fingerprint + "\n";
}

/// Environments of the runs' hashes in this process, by what draws their images.
class Environments {
 public:
  explicit Environments(const SetOptions& options) : options_(options) {}

  /// OpenGL starts in a child, because no child can use that of its parent.
  const NamedValues& of(const ScenarioConfig& scenario) {
    const std::string renderer = format_yaml(scenario.simulation.renderer);
    const auto found = known_.find(renderer);
    if (found != known_.end()) return found->second;
    const std::string text = run_in_child(scenario.name, [&] {
      return json_text(Json(
          hash_environment(options_.libraries ? options_.libraries(scenario) : NamedValues())));
    });
    return known_.emplace(renderer, Json::parse(text).get<NamedValues>()).first->second;
  }

 private:
  const SetOptions& options_;
  std::map<std::string, NamedValues> known_;
};

/// The results in a folder, if they are what this run would have.
std::optional<StoredRun> same_run(const fs::path& folder, const ScenarioConfig& scenario,
                                  const std::string& fingerprint, Environments& environments) {
  if (!has_inputs(folder, fingerprint)) return std::nullopt;
  std::optional<StoredRun> run = read_stored_run(folder / "metrics.json");
  if (!run) return std::nullopt;
  const std::string names =
      environment_differences(run->hash_environment(), environments.of(scenario));
  return names.empty() ? std::move(run) : std::nullopt;
}

/// Comparisons take all repeats of a seed as runs of one system.
void remove_other_repeats(const PlannedRun& first, const std::string& fingerprint,
                          Environments& environments) {
  std::error_code ignored;
  for (const fs::path& folder : {first.folder, first.folder.parent_path()}) {
    if (fs::is_symlink(folder, ignored)) return;
  }
  for (const auto& entry : fs::directory_iterator(first.folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kRepeatFolder) || !entry.is_directory(ignored)) continue;
    if (entry.is_symlink(ignored)) continue;
    if (same_run(entry.path(), *first.settings, fingerprint, environments)) continue;
    for (const char* file : {"metrics.json", kInputsFile}) {
      fs::remove(entry.path() / file, ignored);
    }
  }
}

/// Redirects the output of this process to the file.
void write_messages_to(const fs::path& file) {
  const Descriptor log = create_file(file);
  dup2(log.number(), STDOUT_FILENO);
  dup2(log.number(), STDERR_FILENO);
}

/// In a child process.
std::string run_planned(const PlannedRun& run, const SetOptions& options, int threads) {
  if (run.repeat > 1) create_inner_folder(run.folder.parent_path().parent_path());
  create_inner_folder(run.folder.parent_path());
  create_inner_folder(run.folder);
  const ScenarioConfig scenario = run.scenario();
  const FolderLock lock = prepare_scenario_folder(run.folder, scenario);
  write_messages_to(run.folder / "log.txt");
  RunOptions run_options;
  run_options.folder = run.folder;
  run_options.progress = &std::cerr;
  run_options.title = name_of(run);
  run_options.stopped = options.stopped;
  const std::string fingerprint = fingerprint_of_inputs(scenario);
  const RunOutcome outcome = options.run(scenario, threads, run_options);
  if (outcome.interrupted) return "interrupted";
  // Also where the system failed: a rate of failures counts each run once, whatever it came to.
  write_file_atomically(run.folder / kInputsFile, fingerprint + "\n");
  return "";
}

class RunningSet {
 public:
  RunningSet(const std::vector<PlannedRun>& plan, const SetOptions& options)
      : plan_(plan), options_(options) {
    Environments environments(options);
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const PlannedRun& run = plan[i];
      outcome_.runs.push_back({.scenario = run.title,
                               .seed = run.seed,
                               .folder = run.folder,
                               .repeat = run.repeat,
                               .repeats = run.repeats});
      const std::string fingerprint = fingerprint_of_inputs(run.scenario());
      if (run.repeat == 1) remove_other_repeats(run, fingerprint, environments);
      if (!options.force && keep(outcome_.runs.back(), run, fingerprint, environments)) {
        tell(outcome_.runs.back());
      } else {
        to_run_.push_back(i);
      }
    }
  }

  SetOutcome run() {
    const int at_once = std::min(options_.jobs, static_cast<int>(to_run_.size()));
    const int threads = std::max(1, options_.threads / std::max(1, at_once));
    run_in_children(
        {.count = to_run_.size(),
         .at_once = at_once,
         .name = [&](std::size_t job) { return name_of(plan_[to_run_[job]]); },
         .job =
             [&](std::size_t job) { return run_planned(plan_[to_run_[job]], options_, threads); },
         .done = [&](std::size_t job,
                     const ChildOutcome& child) { finish(outcome_.runs[to_run_[job]], child); },
         .stopped = options_.stopped});
    outcome_.interrupted = outcome_.interrupted || done_ < plan_.size();
    return std::move(outcome_);
  }

 private:
  static bool keep(SetRun& result, const PlannedRun& run, const std::string& fingerprint,
                   Environments& environments) {
    result.result = same_run(run.folder, *run.settings, fingerprint, environments);
    result.kept = result.result.has_value();
    return result.kept;
  }

  static std::optional<StoredRun> read_metrics(const SetRun& run) {
    return read_stored_run(run.folder / "metrics.json");
  }

  void finish(SetRun& result, const ChildOutcome& child) {
    if (child.ok && !child.text.empty()) {
      outcome_.interrupted = true;
      return;
    }
    if (!child.ok) {
      result.error = child.text;
    } else if (result.result = read_metrics(result); !result.result) {
      result.error = fmt::format("{}: has no metrics.json", result.folder.string());
    }
    ++ran_;
    tell(result);
  }

  void tell(const SetRun& run) {
    ++done_;
    if (options_.progress == nullptr) return;
    std::string text = fmt::format("[{}/{}] {}, {}: ", done_, plan_.size(), run.scenario,
                                   seed_text(run.seed, run.repeat, run.repeats));
    if (!run.error.empty()) {
      text += "ERROR, " + run.error;
    } else {
      text += fmt::format(
          "{}{}", run.failed() ? "FAILED" : "passed",
          run.kept ? " (kept)"
                   : fmt::format(" in {:.0f} s", run.result->value("/wall_seconds").value_or(0)));
    }
    *options_.progress << text << time_left() << std::endl;
  }

  /// Estimated from the runs so far.
  std::string time_left() const {
    if (ran_ == 0 || done_ == plan_.size()) return "";
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    const double each = spent.count() / static_cast<double>(ran_);
    const double minutes = each * static_cast<double>(plan_.size() - done_) / 60;
    return minutes < 1 ? ", less than a minute left" : fmt::format(", {:.0f} min left", minutes);
  }

  const std::vector<PlannedRun>& plan_;
  const SetOptions& options_;
  SetOutcome outcome_;
  std::vector<std::size_t> to_run_;  ///< indices into the plan
  std::size_t done_ = 0;
  std::size_t ran_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<PlannedRun> plan_set(const std::vector<ScenarioConfig>& scenarios,
                                 const std::vector<std::int64_t>& seeds, const fs::path& out,
                                 int repeats) {
  std::vector<PlannedRun> plan;
  std::map<std::string, int> names;
  for (const ScenarioConfig& scenario : scenarios) {
    if (++names[scenario.name] > 1) {
      fail("two of the scenarios have the name '{}'; expected unique names", scenario.name);
    }
    const auto settings = std::make_shared<const ScenarioConfig>(scenario);
    const std::vector<std::int64_t> own{scenario.seed};
    for (const std::int64_t seed : seeds.empty() ? own : seeds) {
      PlannedRun run{settings,      seed, out / scenario.name / fmt::format("seed-{}", seed),
                     scenario.name, 1,    repeats};
      plan.push_back(run);
      for (run.repeat = 2; run.repeat <= repeats; ++run.repeat) {
        plan.push_back(run);
        plan.back().folder /= fmt::format("{}{}", kRepeatFolder, run.repeat);
      }
    }
  }
  return plan;
}

ScenarioConfig PlannedRun::scenario() const {
  ScenarioConfig scenario = *settings;
  scenario.seed = seed;
  return scenario;
}

std::string seed_text(std::int64_t seed, int repeat, int repeats) {
  return repeats > 1 ? fmt::format("seed {}, repeat {}", seed, repeat)
                     : fmt::format("seed {}", seed);
}

SetOutcome run_set(const std::vector<PlannedRun>& plan, const SetOptions& options) {
  return RunningSet(plan, options).run();
}

}  // namespace vinebench::harness
