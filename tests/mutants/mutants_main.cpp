// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Plants each fault of the catalogue in turn and prints which gates of the short scenarios fail.
// Usage: mutants [--only NAME]... [--threads N] [SCENARIO...]. The table is Markdown, on standard
// output. Exit code 1 if a scenario fails without a fault, or fewer than 95 % of the faults are
// caught, or the diagnosis names fewer than 90 %. Faults that change no bit of the estimate in any
// scenario, which no judge could catch, do not count.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "core/util/pin_arithmetic.h"
#include "tests/mutants/course.h"

namespace vinebench::mutants {
namespace {

constexpr double kCaught = 0.95;  // share of the faults, at least
constexpr double kNamed = 0.9;    // likewise

struct Caught {
  std::string scenario;
  Outcome outcome;
};

/// The first few.
std::string gates(const Outcome& outcome) {
  constexpr std::size_t kShown = 3;
  std::vector<std::string> kinds;  // goal and guard may have the same
  for (const harness::Check& check : outcome.failed) {
    if (std::ranges::find(kinds, check.what) == kinds.end()) kinds.push_back(check.what);
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, kinds.size()); ++i) {
    text += (i == 0 ? "" : ", ") + kinds[i];
  }
  if (kinds.size() > kShown) text += fmt::format(" and {} more", kinds.size() - kShown);
  return text;
}

/// What is wrong first, then what the error looks like.
std::string diagnosis(const Outcome& outcome) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!outcome.discrepancies.empty()) add(harness::text_of(outcome.discrepancies.front()));
  for (const harness::ErrorPattern& pattern : outcome.patterns) add(harness::text_of(pattern));
  return text;
}

bool names(const Outcome& outcome, const std::string& cause) {
  const auto& wrong = outcome.discrepancies;
  return (!wrong.empty() && wrong.front().of + ": " + wrong.front().what == cause) ||
         std::ranges::any_of(outcome.patterns,
                             [&](const auto& p) { return harness::name_of(p.kind) == cause; }) ||
         std::ranges::any_of(outcome.segments,
                             [&](const auto& s) { return harness::name_of(s.cause) == cause; });
}

/// Whether the diagnosis names what was planted.
bool is_named(const Mutant& mutant, const Outcome& outcome) {
  std::istringstream causes(cause_of(mutant.name));
  for (std::string cause; std::getline(causes, cause, '|');) {
    if (names(outcome, cause)) return true;
  }
  return false;
}

/// Whether poses and covariances are the same to the bit: no judge could tell.
bool same_estimate(const Outcome& a, const Outcome& b) {
  const auto same = [](const StampedPose& one, const StampedPose& other) {
    return one.pose.translation == other.pose.translation &&
           one.pose.rotation.coeffs() == other.pose.rotation.coeffs();
  };
  return a.nees == b.nees && std::ranges::equal(a.estimate, b.estimate, same);
}

/// Where the estimate first differs, for whoever asks why a fault that should not matter does.
std::string first_difference(const Outcome& a, const Outcome& b) {
  if (a.estimate.size() != b.estimate.size()) {
    return fmt::format("{} poses instead of {}", b.estimate.size(), a.estimate.size());
  }
  for (std::size_t i = 0; i < a.estimate.size(); ++i) {
    const Pose& one = a.estimate[i].pose;
    const Pose& other = b.estimate[i].pose;
    if (one.translation == other.translation && one.rotation.coeffs() == other.rotation.coeffs()) {
      continue;
    }
    return fmt::format("pose {} of {} moves by {:.3g} m and {:.3g} rad", i, a.estimate.size(),
                       (one.translation - other.translation).norm(),
                       one.rotation.angularDistance(other.rotation));
  }
  return fmt::format("NEES {:.17g} instead of {:.17g}", b.nees.value_or(0), a.nees.value_or(0));
}

struct Results {
  std::map<std::string, Caught> caught;
  std::set<std::string> effective;  ///< those that change the estimate of a scenario
};

/// Runs those that no scenario has caught yet. False if the scenario fails without a fault.
bool run_course(const std::filesystem::path& scenario, int threads,
                const std::vector<Mutant>& mutants, Results& results) {
  Course course(scenario, threads);
  const Outcome sound = course.run_without_fault();
  fmt::print(stderr, "{}: without a fault: {}\n", course.name(),
             sound.failed.empty() ? "passed" : "FAILED: " + gates(sound));
  if (!sound.failed.empty()) return false;
  for (const Mutant& mutant : mutants) {
    if (results.caught.contains(mutant.name)) continue;
    Outcome outcome = course.run(mutant);
    const bool caught = !outcome.failed.empty();
    const bool effective = caught || !same_estimate(sound, outcome);
    if (effective) results.effective.insert(mutant.name);
    fmt::print(stderr, "{}: {}: {}; {}; {}\n", course.name(), mutant.name,
               caught ? gates(outcome) : "SURVIVED", diagnosis(outcome),
               effective ? first_difference(sound, outcome) : "no effect");
    if (caught) results.caught[mutant.name] = {course.name(), std::move(outcome)};
  }
  return true;
}

/// Whether enough of those that have an effect are caught and named.
bool print_table(const std::vector<Mutant>& mutants, const Results& results) {
  fmt::print(
      "| fault | planted in | what is wrong | caught by | gates that fail | diagnosis | named |\n"
      "|---|---|---|---|---|---|---|\n");
  int named = 0;
  for (const Mutant& mutant : mutants) {
    const auto found = results.caught.find(mutant.name);
    if (found == results.caught.end()) {
      const bool effective = results.effective.contains(mutant.name);
      fmt::print("| `{}` | {} | {} | {} | | | |\n", mutant.name, mutant.part, mutant.text,
                 effective ? "**nothing**" : "no effect");
      continue;
    }
    const auto& [scenario, outcome] = found->second;
    const bool right = is_named(mutant, outcome);
    named += right;
    fmt::print("| `{}` | {} | {} | `{}` | {} | {} | {} |\n", mutant.name, mutant.part, mutant.text,
               scenario, gates(outcome), diagnosis(outcome), right ? "yes" : "**no**");
  }
  const std::size_t effective = results.effective.size();
  fmt::print("\n{} of {} faults are caught; the diagnosis names {} of them. {} have no effect.\n",
             results.caught.size(), effective, named, mutants.size() - effective);
  const auto all = static_cast<double>(effective);
  return static_cast<double>(results.caught.size()) >= kCaught * all && named >= kNamed * all;
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
  std::vector<std::string> scenarios{root + "quick-loop.yaml", root + "short/many-rows-short.yaml",
                                     root + "short/csl-1-short.yaml",
                                     root + "short/hill-gap-short.yaml"};
  std::vector<std::string> only;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("SCENARIO", scenarios, "files of scenarios")->check(CLI::ExistingFile);
  app.add_option("--only", only, "names of faults");
  app.add_option("--threads", threads)->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  const std::vector<Mutant> mutants = chosen(only);
  Results results;
  for (const std::string& scenario : scenarios) {
    if (!run_course(scenario, threads, mutants, results)) return 1;
  }
  return print_table(mutants, results) ? 0 : 1;
}

}  // namespace
}  // namespace vinebench::mutants

int main(int argc, char** argv) {
  vinebench::pin_arithmetic();  // its shaders must not be mixed with other programs'
  try {
    return vinebench::mutants::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "mutants: {}\n", error.what());
    return 2;
  }
}
