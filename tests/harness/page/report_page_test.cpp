// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/support/page_runs.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

nlohmann::ordered_json report_of(const std::string& page) {
  const std::string begin = "id=\"report\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::ordered_json::parse(page.substr(at, page.find("</script>", at) - at));
}

Trial strict_trial() {
  Trial trial = test::fake_trial();
  trial.expectations.ate_rmse_max = 0.001;
  return trial;
}

TEST(ReportPageTest, ARunIsOnePage) {
  const test::TestFolder run;
  test::write_fake_run(run.path(), true);
  const std::string page = report_page({{run.path()}});
  EXPECT_THAT(page, testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("<title>fake, seed 1</title>"));
  EXPECT_THAT(page, HasSubstr("id=\"details-0\""));
  EXPECT_THAT(page, HasSubstr("id=\"pictures-0\""));
  EXPECT_EQ(report_of(page)["runs"][0]["pictures"], 201);
  // Nothing is fetched from anywhere.
  EXPECT_FALSE(std::regex_search(page.substr(0, 2000), std::regex("(src|href)=\"(?!data:|#)")));
}

TEST(ReportPageTest, FailedRunsGetTheirDetailsFirst) {
  const test::TestFolder set;
  test::write_fake_run(set / "good/seed-1", true);
  test::write_fake_run(set / "bad/seed-1", true, strict_trial(), [](Estimate& estimate) {
    if (estimate.stamp > test::seconds(5)) estimate.T_map_body->translation.z() += 0.1;
  });
  const std::string page = report_page({{set / "good", set / "bad"}, {}});
  const auto runs = report_of(page)["runs"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[1]["passed"], false);
  EXPECT_THAT(runs[1]["failed"][0].get<std::string>(), HasSubstr("ATE"));
  EXPECT_LT(page.find("id=\"details-1\""), page.find("id=\"details-0\""));
  EXPECT_THAT(report_of(page)["comparison"].get<std::string>(), HasSubstr("fake"));
}

TEST(ReportPageTest, KeepsItsBudget) {
  const test::TestFolder run;
  test::write_fake_run(run.path(), true);
  const std::size_t whole = report_page({{run.path()}, {}, 100'000'000}).size();
  const std::size_t budget = whole - 50'000;
  const std::string page = report_page({{run.path()}, {}, budget});
  EXPECT_LE(page.size(), budget);
  EXPECT_LT(report_of(page)["runs"][0]["pictures"], 201);
  EXPECT_GT(report_of(page)["runs"][0]["pictures"], 1);
  EXPECT_THAT(test::error_of([&] {
                report_page({{run.path()}, {}, 1000});
              }),
              HasSubstr("figures alone need"));
}

TEST(ReportPageTest, AnInterruptedRunHasNoVerdict) {
  const test::TestFolder run;
  test::write_fake_run(run.path());
  std::filesystem::remove(run / "metrics.json");
  const auto report = report_of(report_page({{run.path()}}));
  EXPECT_EQ(report["runs"][0]["verdict"], "interrupted: no verdict");
  EXPECT_EQ(report["runs"][0]["details"], true);
}

TEST(ReportPageTest, NamesCannotLeaveTheirPlace) {
  const test::TestFolder run;
  Trial trial = test::fake_trial();
  trial.name = "</script><img src=x>";
  test::write_fake_run(run.path(), false, trial);
  EXPECT_THAT(report_page({{run.path()}}), Not(HasSubstr("<img src=x>")));
}

TEST(ReportPageTest, AFolderWithoutRunsIsAnError) {
  const test::TestFolder folder;
  EXPECT_THAT(test::error_of([&] { report_page({{folder.path()}}); }),
              HasSubstr("contains no run"));
  EXPECT_THAT(test::error_of([&] { report_page({{folder / "absent"}}); }),
              HasSubstr("expected a folder of runs"));
}

}  // namespace
}  // namespace vinebench::harness
