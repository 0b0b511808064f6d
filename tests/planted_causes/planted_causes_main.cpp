// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Plants each cause in a short drive, or two of them, measures the harm that they do, explains the
// drive, and prints how often the causes are named by intervention and by coincidence. Usage:
// planted_causes [--seeds 1..7] [--pairs N] [--controls N] [--only NAME]... [--jobs N] [--log FILE]
// [--harm-only]. The table is Markdown, on standard output.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <thread>

#include "harness/sets/child_process.h"
#include "harness/sets/seed_list.h"
#include "tests/planted_causes/case_table.h"

namespace vinebench::planted {
namespace {

struct Options {
  std::string seeds = "1..7";
  std::vector<std::string> only{};
  int pairs = 0;
  int controls = 0;
  int placebos = 4;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string log = "/dev/null";
  bool without_singles = false;
  bool harm_only = false;
};

std::vector<std::size_t> chosen_causes(const std::vector<std::string>& only) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < all_causes().size(); ++i) {
    const PlantedCause& cause = all_causes()[i];
    if (cause.plant && (only.empty() || std::ranges::count(only, cause.name) > 0)) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

std::vector<Case> make_cases(const Options& options) {
  const std::vector<std::size_t> chosen = chosen_causes(options.only);
  const std::vector<std::int64_t> seeds = harness::parse_seeds(options.seeds);
  std::vector<Case> cases;
  for (const std::int64_t seed : seeds) {
    if (options.without_singles) continue;
    for (const std::size_t cause : chosen) cases.push_back({{cause}, seed});
  }
  const int count = static_cast<int>(chosen.size());
  RandomSequence draw(RandomStream(static_cast<std::uint64_t>(seeds.at(0)), "pairs"));
  for (int i = 0; i < options.pairs && count > 1; ++i) {
    const int one = draw.below(count);
    const int other = (one + 1 + draw.below(count - 1)) % count;
    cases.push_back(
        {{chosen[static_cast<std::size_t>(one)], chosen[static_cast<std::size_t>(other)]},
         seeds[static_cast<std::size_t>(i) % seeds.size()]});
  }
  for (int i = 0; i < options.controls; ++i) cases.push_back({{}, seeds.at(0) + i});
  return cases;
}

std::string name_of_case(const Case& one) {
  return fmt::format("{}, seed {}", fmt::join(one.names(), " + "), one.seed);
}

std::string head_of(const Case& one, const Verdict& verdict) {
  const char* judged = !one.causes.empty() && !verdict.harmed ? "no harm"
                       : is_right(one, verdict)               ? "right"
                                                              : "WRONG";
  return fmt::format("{}: {}: {}; coincide: {}; {}; run {:.1f} s, {} reruns {:.1f} s {}\n",
                     name_of_case(one), judged, fmt::join(verdict.named, " + "),
                     fmt::join(verdict.coincide, ", "), verdict.harm, verdict.run_seconds,
                     verdict.reruns, verdict.rerun_seconds, verdict.error);
}

std::vector<Verdict> run_cases(const std::vector<Case>& cases, const Options& options) {
  std::ofstream log(options.log);
  std::vector<Verdict> verdicts(cases.size());
  harness::run_in_children(
      {.count = cases.size(),
       .at_once = options.jobs,
       .name = [&](std::size_t i) { return name_of_case(cases[i]); },
       .job =
           [&](std::size_t i) { return run_case(cases[i], options.placebos, options.harm_only); },
       .done =
           [&](std::size_t i, const harness::ChildOutcome& outcome) {
             if (outcome.ok) {
               verdicts[i] = read_verdict(outcome.text);
             } else {
               verdicts[i].error = outcome.text;
             }
             const std::string head = head_of(cases[i], verdicts[i]);
             fmt::print(stderr, "{}", head);
             log << head << verdicts[i].text << std::flush;
           }});
  return verdicts;
}

int run(int argc, char** argv) {
  CLI::App app("Plants causes and prints how often they are found");
  Options options;
  app.add_option("--seeds", options.seeds, "seeds, such as 1..7");
  app.add_option("--only", options.only, "names of causes");
  app.add_option("--pairs", options.pairs, "drives with two causes");
  app.add_option("--controls", options.controls, "drives without a cause");
  app.add_flag("--without-singles", options.without_singles, "no drives with one cause");
  app.add_flag("--harm-only", options.harm_only, "measure the harm, explain nothing");
  app.add_option("--placebos", options.placebos)->check(CLI::Range(2, 100));
  app.add_option("--jobs", options.jobs)->check(CLI::Range(1, 1024));
  app.add_option("--log", options.log, "file for the explanations");
  CLI11_PARSE(app, argc, argv);
  const std::vector<Case> cases = make_cases(options);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Verdict> verdicts = run_cases(cases, options);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  fmt::print("{}\n{}{} cases in {:.0f} s with {} side by side.\n", format_table(cases, verdicts),
             format_cost(verdicts), cases.size(), wall.count(), options.jobs);
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
