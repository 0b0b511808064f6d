// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/junit.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/util/xml_text.h"

namespace vinebench::harness {
namespace {

double seconds_of(const SetRun& run) {
  return run.result ? run.result->value("/wall_seconds").value_or(0) : 0;
}

std::string failure_of(const std::vector<Check>& checks) {
  if (all_hold(checks)) return "";
  const std::vector<Check> failed = failed_of(checks);
  std::string message;
  for (const Check& check : failed) {
    message += fmt::format("{}{}: {}, expected {}", message.empty() ? "" : "; ", check.what,
                           check.measured, check.expected);
  }
  return fmt::format("      <failure message=\"{}\">{}</failure>\n", xml_escaped(message),
                     xml_escaped(format_checks(failed)));
}

std::string test_case(const std::string& scenario, const std::string& name, double seconds,
                      const std::string& outcome) {
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">\n{}    </testcase>\n",
      xml_escaped(scenario), xml_escaped(name), seconds, outcome);
}

std::string case_name(const SetRun& run) {
  const std::string seed = fmt::format("seed-{}", run.seed);
  return run.repeats > 1 ? fmt::format("{}/repeat-{}", seed, run.repeat) : seed;
}

std::string test_suite(const SeedsSummary& summary) {
  std::string cases;
  double seconds = 0;
  for (const SetRun& run : summary.runs) {
    const std::string outcome =
        run.result ? failure_of(run.result->checks)
                   : fmt::format("      <error message=\"{}\"/>\n", xml_escaped(run.error));
    cases += test_case(summary.scenario, case_name(run), seconds_of(run), outcome);
    seconds += seconds_of(run);
  }
  std::size_t tests = summary.runs.size();
  long failures = std::ranges::count_if(summary.runs, &SetRun::failed);
  for (const auto& [name, checks] :
       {std::pair("median", summary.checks), std::pair("repeats", summary.repeat_checks)}) {
    if (checks.empty()) continue;
    cases += test_case(summary.scenario, name, 0, failure_of(checks));
    ++tests;
    failures += all_hold(checks) ? 0 : 1;
  }
  const auto errors =
      std::ranges::count_if(summary.runs, [](const SetRun& run) { return !run.error.empty(); });
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n{}"
      "  </testsuite>\n",
      xml_escaped(summary.scenario), tests, failures, errors, seconds, cases);
}

}  // namespace

std::string format_junit(const std::vector<SeedsSummary>& scenarios) {
  std::string suites;
  for (const SeedsSummary& summary : scenarios) suites += test_suite(summary);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}  // namespace vinebench::harness
