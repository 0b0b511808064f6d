// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Plants each cause in a short drive, or two of them, measures the harm that they do, explains the
// drive, and prints how often the causes are named by intervention and by coincidence. Usage:
// planted_causes [--seeds 1..7] [--pairs N] [--controls N] [--only NAME]... [--jobs N] [--log FILE]
// [--harm-only] [--minutes M]. The table is Markdown, on standard output.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <set>
#include <thread>

#include "core/util/pin_arithmetic.h"
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
  double minutes = 1e6;  ///< after which no further case is begun
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

/// Two different ones, in their order.
std::vector<std::size_t> draw_pair(const std::vector<std::size_t>& chosen, RandomSequence& draw) {
  const int count = static_cast<int>(chosen.size());
  const int one = draw.below(count);
  const int other = (one + 1 + draw.below(count - 1)) % count;
  return {chosen[static_cast<std::size_t>(std::min(one, other))],
          chosen[static_cast<std::size_t>(std::max(one, other))]};
}

/// Seed by seed, with an even share of the pairs and controls, so that any first part is a sample.
std::vector<Case> make_cases(const Options& options) {
  const std::vector<std::size_t> chosen = chosen_causes(options.only);
  const std::vector<std::int64_t> seeds = harness::parse_seeds(options.seeds);
  const int count = static_cast<int>(seeds.size());
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) {
    const std::int64_t seed = seeds[static_cast<std::size_t>(i)];
    const auto share = [&](int all) { return (i + 1) * all / count - i * all / count; };
    for (const std::size_t cause : chosen) {
      if (!options.without_singles) cases.push_back({{cause}, seed});
    }
    RandomSequence draw(RandomStream(static_cast<std::uint64_t>(seed), "pairs"));
    const int possible = static_cast<int>(chosen.size() * (chosen.size() - 1) / 2);
    const int pairs = std::min(share(options.pairs), possible);
    std::set<std::vector<std::size_t>> drawn;  // each pair once a seed
    while (std::ssize(drawn) < pairs) {
      const std::vector<std::size_t> pair = draw_pair(chosen, draw);
      if (drawn.insert(pair).second) cases.push_back({pair, seed});
    }
    for (int k = 0; k < share(options.controls); ++k) cases.push_back({{}, seed + 100 * k});
  }
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

/// Leaves out of `cases` those that were not begun in time.
std::vector<Verdict> run_cases(std::vector<Case>& cases, const Options& options) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double, std::ratio<60>>(options.minutes);
  std::ofstream log(options.log);
  std::vector<Verdict> verdicts(cases.size());
  std::vector<bool> left_out(cases.size());
  harness::run_in_children({.count = cases.size(),
                            .at_once = options.jobs,
                            .name = [&](std::size_t i) { return name_of_case(cases[i]); },
                            .job =
                                [&](std::size_t i) {
                                  if (Clock::now() > end) return std::string();
                                  return run_case(cases[i], options.placebos, options.harm_only);
                                },
                            .done =
                                [&](std::size_t i, const harness::ChildOutcome& outcome) {
                                  left_out[i] = outcome.ok && outcome.text.empty();
                                  if (left_out[i]) return;
                                  if (outcome.ok) {
                                    verdicts[i] = read_verdict(outcome.text);
                                  } else {
                                    verdicts[i].error = outcome.text;
                                  }
                                  const std::string head = head_of(cases[i], verdicts[i]);
                                  fmt::print(stderr, "{}", head);
                                  log << head << verdicts[i].text << std::flush;
                                }});
  std::vector<Case> begun;
  std::vector<Verdict> found;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (left_out[i]) continue;
    begun.push_back(cases[i]);
    found.push_back(verdicts[i]);
  }
  cases = begun;
  return found;
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
  app.add_option("--minutes", options.minutes, "begin no further case after these");
  app.add_option("--jobs", options.jobs)->check(CLI::Range(1, 1024));
  app.add_option("--log", options.log, "file for the explanations");
  CLI11_PARSE(app, argc, argv);
  std::vector<Case> cases = make_cases(options);
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
    vinebench::pin_arithmetic();  // as the program does
    return vinebench::planted::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "planted_causes: {}\n", error.what());
    return 2;
  }
}
