// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace vinebench::harness {
namespace {

std::string text_of(double value, const char* unit) {
  return fmt::format("{:.4f}{}", value, unit);
}
std::string text_of(int value, const char* unit) {
  return fmt::format("{}{}", value, unit);
}

/// Builds the list; an expectation whose metric was not measured fails.
class Checks {
 public:
  template <class T>
  void at_least(const char* what, const std::optional<T>& asked, const std::optional<T>& measured,
                const char* unit = "") {
    if (asked) add(what, *asked, measured, measured && *measured >= *asked, ">= ", unit);
  }
  template <class T>
  void at_most(const char* what, const std::optional<T>& asked, const std::optional<T>& measured,
               const char* unit = "") {
    if (asked) add(what, *asked, measured, measured && *measured <= *asked, "<= ", unit);
  }
  std::vector<Check> take() { return std::move(checks_); }

 private:
  template <class T>
  void add(const char* what, const T& asked, const std::optional<T>& measured, bool ok,
           const char* sign, const char* unit) {
    checks_.push_back(
        {what, measured ? text_of(*measured, unit) : "none", sign + text_of(asked, unit), ok});
  }
  std::vector<Check> checks_;
};

void check_blind(Checks& checks, const Expectations& asked, const RunResults& results) {
  if (!asked.blind) return;
  const std::optional<OcclusionSegment>& blind = results.blind;
  const double seconds = blind ? blind->seconds : 0;
  checks.at_least<double>("blind in motion", asked.blind->seconds, seconds, " s");
  checks.at_least<double>("inliers' drop while blind", asked.blind->inliers_drop,
                          blind ? blind->inliers_drop() : std::nullopt);
}

constexpr std::size_t kWidestColumn = 40;  // longer texts stand out

std::size_t widest(const std::vector<Check>& checks, std::string Check::*column) {
  std::size_t width = 0;
  for (const Check& check : checks) {
    const std::size_t size = (check.*column).size();
    if (size <= kWidestColumn) width = std::max(width, size);
  }
  return width;
}

}  // namespace

std::vector<Check> check_expectations(const Expectations& asked, const RunResults& results) {
  const auto ate = [](const std::optional<Evaluation>& evaluation,
                      ErrorStatistics Evaluation::*of) {
    return evaluation ? std::optional(((*evaluation).*of).rmse) : std::nullopt;
  };
  const LoopVerdict& loops = results.loops;
  Checks checks;
  checks.at_least<double>("coverage", asked.coverage_min, results.coverage);
  checks.at_most<int>("losses", asked.losses_max, results.losses);
  checks.at_most("ATE, SE(3)-aligned", asked.ate_rmse_max, ate(results.corrected, &Evaluation::ate),
                 " m");
  checks.at_most("ATE, first pose aligned", asked.ate_origin_rmse_max,
                 ate(results.corrected, &Evaluation::origin), " m");
  checks.at_most("distance from the route's end", asked.end_error_max, results.end_error, " m");
  checks.at_least<int>("loop closures, correct", asked.loop_closures_correct_min, loops.correct());
  checks.at_most<int>("loop closures, wrong", asked.loop_closures_wrong_max, loops.wrong());
  checks.at_most<int>("loop closures, missed", asked.loop_closures_missed_max,
                      static_cast<int>(loops.missed.size()));
  check_blind(checks, asked, results);
  return checks.take();
}

bool all_hold(const std::vector<Check>& checks) {
  return std::ranges::all_of(checks, &Check::ok);
}

std::vector<Check> failed_of(const std::vector<Check>& checks) {
  std::vector<Check> failed;
  std::ranges::copy_if(checks, std::back_inserter(failed), [](const Check& c) { return !c.ok; });
  return failed;
}

std::string format_checks(const std::vector<Check>& checks) {
  const std::size_t what = widest(checks, &Check::what);
  const std::size_t measured = widest(checks, &Check::measured);
  const std::size_t expected = widest(checks, &Check::expected);
  std::string text;
  for (const Check& check : checks) {
    text += fmt::format("  {:<{}}  {:>{}}  {:<{}}  {}\n", check.what, what, check.measured,
                        measured, check.expected, expected, check.ok ? "ok" : "FAILED");
  }
  return text;
}

}  // namespace vinebench::harness
