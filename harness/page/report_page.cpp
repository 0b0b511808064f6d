// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/util/error.h"
#include "harness/comparison/comparison_report.h"
#include "harness/page/film_pictures.h"
#include "harness/page/history.h"
#include "harness/page/packed.h"
#include "harness/page/page_html.h"
#include "harness/page/page_parts.h"
#include "harness/page/run_details.h"
#include "harness/report/run_folder.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFrames = 4000;       // drawn of the only run
constexpr std::size_t kMostFramesOfMany = 600;  // of each run of a set

/// A run of the page.
struct ShownRun {
  fs::path folder;
  Json entry;
  bool passed = true;
};

Json columns_json() {
  Json columns = Json::array();
  for (const Metric& metric : shown_metrics()) {
    columns.push_back({{"key", name_of(metric)},
                       {"title", metric.title},
                       {"decimals", metric.decimals},
                       {"larger_is_better", metric.larger_is_better}});
  }
  return columns;
}

Json failed_json(const std::vector<Check>& checks) {
  Json failed = Json::array();
  for (const Check& check : failed_of(checks)) {
    failed.push_back(fmt::format("{}: {}, expected {} ({})", check.what, check.measured,
                                 check.expected, name_of(check.kind)));
  }
  return failed;
}

ShownRun shown(const StoredRun& run, const fs::path& folder, const fs::path& set, int repeat) {
  Json values = Json::array();
  for (const Metric& metric : shown_metrics()) {
    const std::optional<double> value = value_of(metric, run);
    values.push_back(value ? Json(*value) : Json());
  }
  const bool passed = all_hold(run.checks);
  return {folder,
          {{"set", set.string()},
           {"scenario", run.scenario},
           {"seed", run.seed},
           {"repeat", repeat},
           {"folder", folder.string()},
           {"verdict", run.checks.empty() ? "no expectations" : verdict_of(run.checks)},
           {"passed", passed},
           {"failed", failed_json(run.checks)},
           {"version", run.json.value("version", "")},
           {"hash", run.hash()},
           {"values", values}},
          passed};
}

/// A run that was interrupted, or is a recording's: it has files and no metrics.
ShownRun unfinished(const fs::path& folder) {
  return {folder,
          {{"set", folder.string()},
           {"scenario", folder.filename().string()},
           {"seed", nullptr},
           {"repeat", 1},
           {"folder", folder.string()},
           {"verdict", "interrupted: no verdict"},
           {"passed", false},
           {"failed", Json::array()},
           {"version", ""},
           {"hash", ""},
           {"values", Json::array()}},
          false};
}

std::vector<ShownRun> runs_of(const fs::path& folder) {
  std::error_code ignored;
  if (is_run_folder(folder) && !fs::is_regular_file(folder / "metrics.json", ignored)) {
    return {unfinished(folder)};
  }
  std::vector<ShownRun> runs;
  for (const SeedRuns& found : find_runs(folder)) {
    for (std::size_t i = 0; i < found.repeats.size(); ++i) {
      const int repeat = static_cast<int>(i) + 1;
      const fs::path of_repeat =
          i == 0 ? found.folder : found.folder / fmt::format("{}{}", kRepeatFolder, repeat);
      runs.push_back(shown(found.repeats[i], of_repeat, folder, repeat));
    }
  }
  return runs;
}

std::string element(const std::string& id, const std::string& text) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
}

/// What is left of the budget is filled in turn.
class Budget {
 public:
  explicit Budget(std::size_t bytes) : left_(bytes) {}
  bool take(std::size_t bytes) {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }
  std::size_t left() const { return left_; }

 private:
  std::size_t left_;
};

/// Failed runs first.
std::vector<std::size_t> order_of(const std::vector<ShownRun>& runs) {
  std::vector<std::size_t> order(runs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return runs[i].passed; });
  return order;
}

std::string details_text(std::vector<ShownRun>& runs, Budget& budget) {
  std::string text;
  for (const std::size_t i : order_of(runs)) {
    const std::size_t frames = runs.size() == 1 ? kMostFrames : kMostFramesOfMany;
    const std::string details = packed(run_details(runs[i].folder, frames));
    const bool fits = budget.take(details.size());
    runs[i].entry["details"] = fits;
    if (fits) text += element(fmt::format("details-{}", i), details);
  }
  return text;
}

std::string films_text(std::vector<ShownRun>& runs, Budget& budget) {
  std::string text;
  std::size_t waiting = runs.size();
  for (const std::size_t i : order_of(runs)) {
    const std::size_t share = budget.left() / waiting--;
    runs[i].entry["pictures"] = 0;
    if (!runs[i].entry["details"].get<bool>()) continue;
    const auto film = film_pictures(runs[i].folder, share * 9 / 10);
    if (!film) continue;
    const std::string index = packed(film->index);
    if (index.size() + film->bytes > share || !budget.take(index.size() + film->bytes)) continue;
    runs[i].entry["pictures"] = film->pictures.size();
    text += element(fmt::format("film-{}", i), index);
    text += element(fmt::format("pictures-{}", i), script_text(film->pictures));
  }
  return text;
}

/// Of two sets, what `vinebench compare` says.
Json comparison_of(const std::vector<fs::path>& folders) {
  if (folders.size() != 2) return nullptr;
  return format_comparison(pair_runs(folders[0], folders[1]), {});
}

std::string title_of(const ReportRequest& request, const std::vector<ShownRun>& runs) {
  if (runs.size() == 1) {
    const Json& run = runs.front().entry;
    return run["seed"].is_null() ? run["scenario"].get<std::string>()
                                 : fmt::format("{}, seed {}", run["scenario"].get<std::string>(),
                                               run["seed"].get<std::int64_t>());
  }
  return request.folders.empty() ? request.history.string() : request.folders.front().string();
}

}  // namespace

std::string report_page(const ReportRequest& request) {
  std::vector<ShownRun> runs;
  for (const fs::path& folder : request.folders) {
    for (ShownRun& run : runs_of(folder)) runs.push_back(std::move(run));
  }
  Json report{{"title", title_of(request, runs)},
              {"version", kVersion},
              {"columns", columns_json()},
              {"comparison", comparison_of(request.folders)},
              {"history", request.history.empty() ? Json() : history_json(request.history)}};
  report["runs"] = Json::array();
  for (const ShownRun& run : runs) report["runs"].push_back(run.entry);
  constexpr std::size_t kRest = 64;  // bytes a run, for what is added to its entry
  const std::size_t fixed = page_script().size() + page_style().size() +
                            script_text(report).size() + kRest * (runs.size() + 16);
  if (fixed > request.budget) {
    fail("the report's figures alone need {:.1f} MB, more than the {:.1f} MB that it may have",
         1e-6 * static_cast<double>(fixed), 1e-6 * static_cast<double>(request.budget));
  }
  Budget budget(request.budget - fixed);
  const std::string details = details_text(runs, budget);
  const std::string films = films_text(runs, budget);
  report["runs"] = Json::array();
  for (const ShownRun& run : runs) report["runs"].push_back(run.entry);
  return page_html(report["title"].get<std::string>(), report, details + films);
}

}  // namespace vinebench::harness
