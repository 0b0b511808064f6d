// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <utility>

#include "core/files/files.h"
#include "core/files/json_depth.h"
#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/report/run_folder.h"
#include "harness/run/run_hash.h"
#include "harness/sets/run_inputs.h"
#include "harness/sets/seed_list.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Of the file; counted up when it changes.
constexpr int kFormat = 1;

fs::path folder_of(const SweepCell& cell, const std::string& name, std::int64_t seed, int repeat) {
  const fs::path first = cell.folder() / name / fmt::format("seed-{}", seed);
  return repeat == 1 ? first : first / fmt::format("{}{}", kRepeatFolder, repeat);
}

Json json_of(const SweepCell& cell) {
  Json json{{"scenario", cell.scenario}};
  if (!cell.system.empty()) json["system"] = cell.system;
  if (!cell.point.empty()) json["point"] = cell.point;
  Json set = Json::array();
  for (const auto& [key, value] : cell.overrides) set.push_back(key + "=" + value);
  json["set"] = set;
  return json;
}

SweepCell cell_of(const Json& json) {
  SweepCell cell{json.at("scenario").get<std::string>(), json.value("system", "")};
  if (json.contains("point")) json["point"].get_to(cell.point);
  for (const Json& text : json.at("set")) {
    cell.overrides.push_back(parse_override(text.get<std::string>()));
  }
  return cell;
}

Json json_of(const SweepTask& task, const SweepCell& cell) {
  Json json = json_of(cell);
  json["seed"] = task.seed;
  json["repeat"] = task.repeat;
  json["cost_s"] = task.cost;
  json["key"] = task.key;
  json["folder"] = task.folder;
  return json;
}

/// A folder inside of another, as a plan is a file that anybody may have written.
std::string inner_folder(const std::string& text) {
  const fs::path folder = fs::path(text).lexically_normal();
  if (folder.empty() || folder.is_absolute() || *folder.begin() == ".." || *folder.begin() == ".") {
    fail("folder: '{}': expected one inside of that for the results", text);
  }
  return folder.string();
}

void read_header(const Json& json, SweepPlan& plan, std::size_t& tasks) {
  if (const int format = json.at("sweep_plan"); format != kFormat) {
    fail("expected format {}, found {}: make the plan again with this program", kFormat, format);
  }
  json.at("version").get_to(plan.build.version);
  json.at("program").get_to(plan.build.program);
  json.at("repeats").get_to(plan.repeats);
  json.at("tasks").get_to(tasks);
}

void read_task(const Json& json, SweepPlan& plan) {
  SweepCell cell = cell_of(json);
  if (plan.cells.empty() || plan.cells.back() != cell) plan.cells.push_back(std::move(cell));
  SweepTask task;
  task.cell = plan.cells.size() - 1;
  json.at("seed").get_to(task.seed);
  json.at("repeat").get_to(task.repeat);
  json.at("cost_s").get_to(task.cost);
  json.at("key").get_to(task.key);
  task.folder = inner_folder(json.at("folder"));
  if (!(task.cost >= 0)) fail("cost_s: expected a number from 0");
  plan.tasks.push_back(std::move(task));
}

Json parse_line(const std::string& line) {
  check_json_depth(line, "plan");
  return Json::parse(line);
}

}  // namespace

Build this_build() {
  return {kVersion, program_digits()};
}

SweepPlan make_plan(const SweepSpec& spec, const ScenarioLoader& load, const CostEstimate& cost) {
  SweepPlan plan{this_build(), spec.repeats, cells_of(spec), {}};
  std::map<std::string, std::string> scenarios;  // by name
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const SweepCell& cell = plan.cells[c];
    const ScenarioConfig scenario = load(cell.scenario, cell.overrides);
    if (scenarios.emplace(scenario.name, cell.scenario).first->second != cell.scenario) {
      fail("scenarios {} and {} have the same name '{}'; expected unique names",
           scenarios[scenario.name], cell.scenario, scenario.name);
    }
    const double seconds = cost(scenario);
    const RunInputs inputs(scenario);
    const std::vector<std::int64_t> own{scenario.seed};
    for (const std::int64_t seed : spec.seeds.empty() ? own : parse_seeds(spec.seeds)) {
      const std::string key = inputs.fingerprint(seed);
      for (int repeat = 1; repeat <= spec.repeats; ++repeat) {
        plan.tasks.push_back(
            {c, seed, repeat, key, seconds, folder_of(cell, scenario.name, seed, repeat).string()});
      }
    }
  }
  return plan;
}

std::string format_plan(const SweepPlan& plan) {
  double cost = 0;
  for (const SweepTask& task : plan.tasks) cost += task.cost;
  std::string text = json_text(Json{{"sweep_plan", kFormat},
                                    {"version", plan.build.version},
                                    {"program", plan.build.program},
                                    {"repeats", plan.repeats},
                                    {"tasks", plan.tasks.size()},
                                    {"cost_s", cost}}) +
                     "\n";
  for (const SweepTask& task : plan.tasks) {
    text += json_text(json_of(task, plan.cells[task.cell])) + "\n";
  }
  return text;
}

SweepPlan read_plan(const fs::path& file) {
  SweepPlan plan;
  std::istringstream lines(read_file(file));
  std::size_t expected = 0;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      const Json json = parse_line(line);
      if (number == 1) {
        read_header(json, plan, expected);
      } else {
        read_task(json, plan);
      }
    } catch (const nlohmann::json::exception&) {
      fail("{}:{}: expected a line of a plan as `vinebench sweep plan` prints it", file.string(),
           number);
    } catch (const Error& error) {
      fail("{}:{}: {}", file.string(), number, error.what());
    }
  }
  if (number == 0) {
    fail("{}: is empty: expected a plan as `vinebench sweep plan` prints it", file.string());
  }
  if (plan.tasks.size() != expected) {
    fail("{}: expected {} tasks, found {}: a part of the file is missing", file.string(), expected,
         plan.tasks.size());
  }
  return plan;
}

std::vector<PlannedRun> planned_runs(const SweepPlan& plan, const std::vector<std::size_t>& tasks,
                                     const ScenarioLoader& load, const fs::path& out) {
  if (const Build here = this_build(); plan.build != here) {
    fail(
        "the plan was made by another build of the program (version {}, {}; this one is {}, {}): "
        "make it again with this one, or run it with that",
        plan.build.version, plan.build.program, here.version, here.program);
  }
  struct Settings {
    std::shared_ptr<const ScenarioConfig> scenario;
    RunInputs inputs;
  };
  std::map<std::size_t, Settings> cells;
  std::vector<PlannedRun> runs;
  for (const std::size_t t : tasks) {
    const SweepTask& task = plan.tasks[t];
    const SweepCell& cell = plan.cells[task.cell];
    auto known = cells.find(task.cell);
    if (known == cells.end()) {
      const auto scenario =
          std::make_shared<const ScenarioConfig>(load(cell.scenario, cell.overrides));
      known = cells.emplace(task.cell, Settings{scenario, RunInputs(*scenario)}).first;
    }
    const auto& [scenario, inputs] = known->second;
    const std::string label = cell.label();
    PlannedRun run{scenario,          task.seed,
                   out / task.folder, scenario->name + (label.empty() ? "" : ", " + label),
                   task.repeat,       plan.repeats};
    if (inputs.fingerprint(task.seed) != task.key) {
      fail(
          "{}, seed {}: is not what it was when the plan was made (the scenario, or a file that it "
          "names, has changed): make the plan again",
          run.title, task.seed);
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace vinebench::harness
