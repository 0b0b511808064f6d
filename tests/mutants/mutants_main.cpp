// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Plants each fault of the catalogue in turn and prints which gates of the short scenarios fail.
// Usage: mutants [--only NAME]... [--threads N] [SCENARIO...]. The table is Markdown, on standard
// output. Exit code 1 if a scenario fails without a fault, or fewer than 95 % of the faults are
// caught.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <thread>

#include "tests/mutants/course.h"

namespace vinebench::mutants {
namespace {

constexpr double kCaught = 0.95;  // share of the faults, at least

struct Caught {
  std::string scenario;
  Outcome outcome;
};

std::string gates(const Outcome& outcome) {
  std::string text;
  for (const harness::Check& check : outcome.failed) {
    text += (text.empty() ? "" : ", ") + check.what;
  }
  return text;
}

std::string patterns(const Outcome& outcome) {
  std::string text;
  for (const harness::ErrorPattern& pattern : outcome.patterns) {
    text += (text.empty() ? "" : ", ") + harness::text_of(pattern);
  }
  return text;
}

/// Runs those that no scenario has caught yet. False if the scenario fails without a fault.
bool run_course(const std::filesystem::path& scenario, int threads,
                const std::vector<Mutant>& mutants, std::map<std::string, Caught>& caught) {
  Course course(scenario, threads);
  const Outcome sound = course.run_without_fault();
  fmt::print(stderr, "{}: without a fault: {}\n", course.name(),
             sound.failed.empty() ? "passed" : "FAILED: " + gates(sound));
  if (!sound.failed.empty()) return false;
  for (const Mutant& mutant : mutants) {
    if (caught.contains(mutant.name)) continue;
    Outcome outcome = course.run(mutant);
    fmt::print(stderr, "{}: {}: {}; {}\n", course.name(), mutant.name,
               outcome.failed.empty() ? "SURVIVED" : gates(outcome), patterns(outcome));
    if (!outcome.failed.empty()) caught[mutant.name] = {course.name(), std::move(outcome)};
  }
  return true;
}

void print_table(const std::vector<Mutant>& mutants, const std::map<std::string, Caught>& caught) {
  fmt::print(
      "| fault | planted in | what is wrong | caught by | gates that fail | pattern of the error "
      "|\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const Mutant& mutant : mutants) {
    const auto found = caught.find(mutant.name);
    const bool survived = found == caught.end();
    fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", mutant.name, mutant.part, mutant.text,
               survived ? "**nothing**" : "`" + found->second.scenario + "`",
               survived ? "" : gates(found->second.outcome),
               survived ? "" : patterns(found->second.outcome));
  }
  fmt::print("\n{} of {} faults are caught.\n", caught.size(), mutants.size());
}

std::vector<Mutant> chosen(const std::vector<std::string>& names) {
  std::vector<Mutant> list = all_mutants();
  if (names.empty()) return list;
  std::erase_if(list, [&](const Mutant& mutant) {
    return std::ranges::find(names, mutant.name) == names.end();
  });
  return list;
}

int run(int argc, char** argv) {
  CLI::App app("Plants faults and prints which gates of the scenarios fail");
  const std::string root = VINEBENCH_SOURCE_DIR "/scenarios/";
  std::vector<std::string> scenarios{root + "quick-loop.yaml", root + "short/csl-1-short.yaml",
                                     root + "short/many-rows-short.yaml"};
  std::vector<std::string> only;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("SCENARIO", scenarios, "files of scenarios")->check(CLI::ExistingFile);
  app.add_option("--only", only, "names of faults");
  app.add_option("--threads", threads)->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  const std::vector<Mutant> mutants = chosen(only);
  std::map<std::string, Caught> caught;
  for (const std::string& scenario : scenarios) {
    if (!run_course(scenario, threads, mutants, caught)) return 1;
  }
  print_table(mutants, caught);
  const auto share = static_cast<double>(caught.size()) / static_cast<double>(mutants.size());
  return share >= kCaught ? 0 : 1;
}

}  // namespace
}  // namespace vinebench::mutants

int main(int argc, char** argv) {
  try {
    return vinebench::mutants::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "mutants: {}\n", error.what());
    return 2;
  }
}
