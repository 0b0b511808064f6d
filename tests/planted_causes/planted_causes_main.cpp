// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Plants each cause in a short drive, or two of them, runs it, explains it, and prints how often
// the causes are named by intervention and by coincidence. Usage: planted_causes [--seeds 1..7]
// [--pairs N] [--controls N] [--only NAME]... [--jobs N] [--log FILE]. The table is Markdown, on
// standard output.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/files/output_folder.h"
#include "harness/explain/explanation_text.h"
#include "harness/explain/run_to_explain.h"
#include "harness/jobs/run_scenario.h"
#include "harness/judge/diagnosis.h"
#include "harness/sets/child_process.h"
#include "harness/sets/seed_list.h"
#include "tests/planted_causes/planted_cause.h"

namespace vinebench::planted {
namespace {

using harness::DegradedSegment;
using Json = nlohmann::json;

constexpr double kFrom = 1.2;  // s, of the stretch, which lasts to the end
constexpr double kLead = 0.8;  // s

struct Case {
  std::vector<std::size_t> causes;
  std::int64_t seed = 1;
};

struct Verdict {
  std::vector<std::string> named;
  std::vector<std::string> coincide;  ///< names of the diagnosis, the strongest first
  double run_seconds = 0;             ///< processor time of the run
  double rerun_seconds = 0;           ///< of a rerun, on average
  double drift = 0;                   ///< m
  std::string text;
  std::string error;
};

std::vector<std::string> planted_names(const Case& one) {
  std::vector<std::string> names;
  for (const std::size_t cause : one.causes) names.push_back(all_causes()[cause].name);
  return names;
}

/// The diagnosis of the run: causes of segments that reach into the stretch.
std::vector<std::string> coinciding(const std::vector<DegradedSegment>& diagnosis,
                                    std::int64_t first) {
  std::vector<std::string> names;
  for (const DegradedSegment& segment : diagnosis) {
    if (static_cast<std::int64_t>(segment.last) < first) continue;
    names.emplace_back(harness::name_of(segment.cause));
  }
  return names;
}

/// In a process of its own.
std::string run_case(const std::filesystem::path& file, const Case& one, int placebos) {
  const harness::ScenarioConfig scenario = planted_drive(file, one.causes, one.seed);
  const harness::Machine machine = harness::machine_of_environment();
  const TemporaryFolder folder;
  const std::string ran = harness::run_in_child("run", [&] {
    harness::RunOptions options;
    options.folder = folder.path();
    options.images = 0;
    const FolderLock lock = harness::prepare_scenario_folder(folder.path(), scenario);
    const auto first = static_cast<std::int64_t>(kFrom * 15);
    const harness::RunReport report = harness::run_scenario(scenario, machine, 1, options).report;
    return Json{{"coincide", coinciding(report.diagnosis, first)},
                {"seconds", report.cost.cpu_seconds}}
        .dump();
  });
  harness::ExplainRequest request =
      harness::read_run(folder.path(), {.number = {}, .from = kFrom, .to = {}});
  request.machine = machine;
  request.lead = kLead;
  request.placebos = placebos;
  const harness::Explanation explanation = harness::explain(request);
  Json json = Json::parse(ran);
  for (const std::size_t i : explanation.stretches[0].causes) {
    json["named"].push_back(explanation.factors[i].name);
  }
  json["rerun"] = explanation.rerun_seconds / explanation.reruns;
  json["drift"] = explanation.stretches[0].was.metres;
  json["text"] = harness::format_explanation(explanation, 15);
  return json.dump();
}

Verdict verdict_of(const harness::ChildOutcome& outcome) {
  Verdict verdict;
  if (!outcome.ok) {
    verdict.error = outcome.text;
    return verdict;
  }
  const Json json = Json::parse(outcome.text);
  verdict.named = json.value("named", std::vector<std::string>());
  verdict.coincide = json.value("coincide", std::vector<std::string>());
  verdict.run_seconds = json.at("seconds");
  verdict.rerun_seconds = json.at("rerun");
  verdict.drift = json.at("drift");
  verdict.text = json.at("text");
  return verdict;
}

/// The first ones named are those that were planted, in any order; none, where none was.
bool is_right(const Case& one, const Verdict& verdict) {
  std::vector<std::string> expected = planted_names(one);
  if (expected.empty()) return verdict.named.empty() && verdict.error.empty();
  if (verdict.named.size() < expected.size()) return false;
  std::vector<std::string> first(verdict.named.begin(),
                                 verdict.named.begin() + std::ssize(expected));
  std::ranges::sort(first);
  std::ranges::sort(expected);
  return first == expected;
}

bool coincides(std::size_t cause, const std::string& name) {
  return std::ranges::any_of(all_causes()[cause].coinciding,
                             [&](harness::Cause known) { return name == harness::name_of(known); });
}

/// The same for the diagnosis.
bool is_right_by_coincidence(const Case& one, const Verdict& verdict) {
  std::vector<std::string> names;
  for (const std::string& name : verdict.coincide) {
    if (std::ranges::count(names, name) == 0) names.push_back(name);
  }
  if (one.causes.empty()) return names.empty();
  if (names.size() < one.causes.size()) return false;
  names.resize(one.causes.size());
  return std::ranges::all_of(one.causes, [&](std::size_t cause) {
    return std::ranges::any_of(names, [&](const auto& name) { return coincides(cause, name); });
  });
}

struct Row {
  int cases = 0;
  int right = 0;
  int none = 0;    ///< none was named
  int others = 0;  ///< others were named first, or too few
  int failed = 0;
  int coincide = 0;
  std::map<std::string, int> wrong;
};

void count(const Case& one, const Verdict& verdict, Row& row) {
  ++row.cases;
  if (!verdict.error.empty()) {
    ++row.failed;
    return;
  }
  row.coincide += is_right_by_coincidence(one, verdict) ? 1 : 0;
  if (is_right(one, verdict)) {
    ++row.right;
  } else if (verdict.named.empty()) {
    ++row.none;
  } else {
    ++row.others;
    ++row.wrong[fmt::format("{}", fmt::join(verdict.named, " + "))];
  }
}

void print_row(const std::string& name, const Row& row) {
  std::string wrong;
  for (const auto& [named, times] : row.wrong) {
    wrong += fmt::format("{}{}{}", wrong.empty() ? "" : ", ", named,
                         times > 1 ? fmt::format(" ({})", times) : "");
  }
  if (row.failed > 0) wrong += fmt::format(" ({} failed)", row.failed);
  fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", name, row.cases, row.right, row.none,
             row.others, row.coincide, wrong);
}

void add(Row& sum, const Row& row) {
  sum.cases += row.cases;
  sum.right += row.right;
  sum.none += row.none;
  sum.others += row.others;
  sum.failed += row.failed;
  sum.coincide += row.coincide;
}

void print_table(const std::vector<Case>& cases, const std::vector<Verdict>& verdicts) {
  fmt::print(
      "| planted | cases | right | none named | others named first | right by coincidence | named "
      "instead |\n|---|---|---|---|---|---|---|\n");
  for (const std::size_t planted : {1, 2, 0}) {
    std::map<std::string, Row> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].causes.size() != planted) continue;
      count(cases[i], verdicts[i],
            rows[fmt::format("{}", fmt::join(planted_names(cases[i]), " + "))]);
    }
    Row sum;
    for (const auto& [name, row] : rows) {
      if (planted > 0) print_row("`" + name + "`", row);
      add(sum, row);
    }
    const char* kind = planted == 1 ? "one cause" : planted == 2 ? "two causes" : "nothing";
    if (sum.cases > 0) print_row(fmt::format("**{}**", kind), sum);
  }
  double run = 0;
  double rerun = 0;
  for (const Verdict& verdict : verdicts) {
    run += verdict.run_seconds;
    rerun += verdict.rerun_seconds;
  }
  fmt::print("\nA rerun takes {:.0f} % of a run's processor time.\n", 100 * rerun / run);
}

std::vector<Case> make_cases(const std::vector<std::string>& only,
                             const std::vector<std::int64_t>& seeds, int pairs, int controls) {
  const auto is_chosen = [&](std::size_t cause) {
    return all_causes()[cause].plant &&
           (only.empty() || std::ranges::count(only, all_causes()[cause].name) > 0);
  };
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < all_causes().size(); ++i) {
    if (is_chosen(i)) chosen.push_back(i);
  }
  std::vector<Case> cases;
  for (const std::int64_t seed : seeds) {
    for (const std::size_t cause : chosen) cases.push_back({{cause}, seed});
  }
  const int count = static_cast<int>(chosen.size());
  RandomSequence draw(RandomStream(static_cast<std::uint64_t>(seeds.at(0)), "pairs"));
  for (int i = 0; i < pairs && count > 1; ++i) {
    const int one = draw.below(count);
    const int other = (one + 1 + draw.below(count - 1)) % count;
    cases.push_back(
        {{chosen[static_cast<std::size_t>(one)], chosen[static_cast<std::size_t>(other)]},
         seeds[static_cast<std::size_t>(i) % seeds.size()]});
  }
  for (int i = 0; i < controls; ++i) {
    cases.push_back({{}, seeds.at(0) + i});
  }
  return cases;
}

std::string name_of_case(const Case& one) {
  return fmt::format("{}, seed {}", fmt::join(planted_names(one), " + "), one.seed);
}

std::vector<Verdict> run_cases(const std::vector<Case>& cases, int jobs, int placebos,
                               std::ostream& log) {
  const std::filesystem::path file = VINEBENCH_SOURCE_DIR "/tests/planted_causes/drive.yaml";
  std::vector<Verdict> verdicts(cases.size());
  harness::run_in_children(
      {.count = cases.size(),
       .at_once = jobs,
       .name = [&](std::size_t i) { return name_of_case(cases[i]); },
       .job = [&](std::size_t i) { return run_case(file, cases[i], placebos); },
       .done =
           [&](std::size_t i, const harness::ChildOutcome& outcome) {
             verdicts[i] = verdict_of(outcome);
             const Verdict& verdict = verdicts[i];
             const std::string head = fmt::format(
                 "{}: {}: {}; coincide: {}; run {:.1f} s, rerun {:.1f} s {}\n",
                 name_of_case(cases[i]), is_right(cases[i], verdict) ? "right" : "WRONG",
                 fmt::join(verdict.named, " + "), fmt::join(verdict.coincide, ", "),
                 verdict.run_seconds, verdict.rerun_seconds, verdict.error);
             fmt::print(stderr, "{}", head);
             log << head << verdict.text << std::flush;
           }});
  return verdicts;
}

int run(int argc, char** argv) {
  CLI::App app("Plants causes and prints how often they are found");
  std::string seeds = "1..7";
  std::vector<std::string> only;
  int pairs = 0;
  int controls = 0;
  int placebos = 4;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string log = "/dev/null";
  bool without_singles = false;
  app.add_option("--seeds", seeds, "seeds, such as 1..7");
  app.add_option("--only", only, "names of causes");
  app.add_option("--pairs", pairs, "drives with two causes");
  app.add_option("--controls", controls, "drives without a cause");
  app.add_flag("--without-singles", without_singles, "no drives with one cause");
  app.add_option("--placebos", placebos)->check(CLI::Range(2, 100));
  app.add_option("--jobs", jobs)->check(CLI::Range(1, 1024));
  app.add_option("--log", log, "file for the explanations");
  CLI11_PARSE(app, argc, argv);
  std::vector<Case> cases = make_cases(only, harness::parse_seeds(seeds), pairs, controls);
  if (without_singles) std::erase_if(cases, [](const Case& one) { return one.causes.size() == 1; });
  std::ofstream file(log);
  const auto start = std::chrono::steady_clock::now();
  print_table(cases, run_cases(cases, jobs, placebos, file));
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  fmt::print("{} cases in {:.0f} s with {} side by side.\n", cases.size(), wall.count(), jobs);
  return 0;
}

}  // namespace
}  // namespace vinebench::planted

int main(int argc, char** argv) {
  try {
    return vinebench::planted::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "planted_causes: {}\n", error.what());
    return 2;
  }
}
