// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/junit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/set_runs.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

TEST(JunitTest, HasACaseForEachSeed) {
  const SeedsSummary summary{
      .scenario = "row",
      .runs = {test::set_run(1, 0.01), test::set_run(2, 0.01, false), test::crashed_run(3)}};
  EXPECT_EQ(format_junit({summary}),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites>\n"
            "  <testsuite name=\"row\" tests=\"3\" failures=\"1\" errors=\"1\" time=\"3.000\">\n"
            "    <testcase classname=\"row\" name=\"seed-1\" time=\"1.500\">\n"
            "    </testcase>\n"
            "    <testcase classname=\"row\" name=\"seed-2\" time=\"1.500\">\n"
            "      <failure message=\"losses: 2, expected &lt;= 0\">"
            "  losses  2  &lt;= 0  FAILED&#10;</failure>\n"
            "    </testcase>\n"
            "    <testcase classname=\"row\" name=\"seed-3\" time=\"0.000\">\n"
            "      <error message=\"ended by signal 9\"/>\n"
            "    </testcase>\n"
            "  </testsuite>\n"
            "</testsuites>\n");
}

TEST(JunitTest, TheMedianIsACaseOfItsOwn) {
  SeedsSummary summary{.scenario = "row", .runs = {test::set_run(1, 0.01)}};
  summary.checks = {{"median & more", "2 m", "<= 1 m", false}};
  const std::string xml = format_junit({summary});
  EXPECT_THAT(xml, HasSubstr("tests=\"2\" failures=\"1\" errors=\"0\""));
  EXPECT_THAT(xml, HasSubstr("name=\"median\" time=\"0.000\""));
  EXPECT_THAT(xml, HasSubstr("median &amp; more: 2 m, expected &lt;= 1 m"));
  summary.checks[0].ok = true;
  EXPECT_THAT(format_junit({summary}), HasSubstr("tests=\"2\" failures=\"0\""));
}

TEST(JunitTest, RepeatsAreCasesOfTheirOwn) {
  SeedsSummary summary{.scenario = "row",
                       .runs = {test::set_run(1, 0.01), test::set_run(1, 0.01, false)}};
  for (int i : {0, 1}) {
    summary.runs[static_cast<std::size_t>(i)].repeat = i + 1;
    summary.runs[static_cast<std::size_t>(i)].repeats = 2;
  }
  summary.repeat_checks = {{"repeats agree by hash", "1 seeds differ", "0 seeds differ", false}};
  const std::string xml = format_junit({summary});
  EXPECT_THAT(xml, HasSubstr("tests=\"3\" failures=\"2\" errors=\"0\""));
  EXPECT_THAT(xml, HasSubstr("name=\"seed-1/repeat-2\""));
  EXPECT_THAT(xml, HasSubstr("name=\"repeats\" time=\"0.000\""));
}

TEST(JunitTest, ASuiteForEachScenario) {
  const SeedsSummary a{.scenario = "a<b", .runs = {test::set_run(1, 0.01)}};
  const SeedsSummary b{.scenario = "b", .runs = {test::set_run(1, 0.01)}};
  const std::string xml = format_junit({a, b});
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"a&lt;b\""));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"b\""));
}

}  // namespace
}  // namespace vinebench::harness
