// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/run_details.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/page_runs.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

TEST(RunDetailsTest, HasEveryFrame) {
  const test::TestFolder run;
  test::write_fake_run(run.path());
  const Json details = run_details(run.path(), 1000);
  EXPECT_EQ(details["t"].size(), 201u);
  EXPECT_EQ(details["frame"][200], 200);
  EXPECT_EQ(details["status"], std::string(201, 't'));
  EXPECT_EQ(details["keyframes"], (Json{0, 50, 100, 150, 200}));
  EXPECT_EQ(details["truth"].size(), 7u);
  EXPECT_EQ(details["truth"][0][100], -1.0);  // half way round the circle of 1 m
  EXPECT_EQ(details["estimate"][0][100], -1.0);
  EXPECT_EQ(details["error"][100], 0);
  EXPECT_EQ(details["inliers"][1][7], 80);
  EXPECT_EQ(details["occluded"][0][100], 0.95);
  EXPECT_EQ(details["site"]["tags"][0]["id"], 7);
  EXPECT_EQ(details["metrics"]["scenario"], "fake");
  EXPECT_EQ(details["settings"]["text"], test::kFakeSettings);
}

TEST(RunDetailsTest, ErrorsAreInMillimetresWithTheFirstPosesAligned) {
  const test::TestFolder run;
  test::write_fake_run(run.path(), false, test::fake_trial(), [](Estimate& estimate) {
    if (estimate.stamp >= test::seconds(5)) estimate.T_map_body->translation.z() += 0.012;
  });
  const Json details = run_details(run.path(), 1000);
  EXPECT_EQ(details["error"][10], 0);
  EXPECT_EQ(details["error"][60], 12);
  EXPECT_EQ(details["live_error"][60], 12);
}

TEST(RunDetailsTest, LongRunsAreThinnedOut) {
  const test::TestFolder run;
  test::write_fake_run(run.path());
  const Json details = run_details(run.path(), 100);  // 201 frames: every third
  EXPECT_EQ(details["step"], 3);
  EXPECT_EQ(details["t"].size(), 67u);
  EXPECT_EQ(details["frame"][1], 3);
  EXPECT_EQ(details["inliers"][0].size(), 67u);
  EXPECT_EQ(details["status"].get<std::string>().size(), 67u);
}

TEST(RunDetailsTest, AnOlderRunHasWhatItHas) {
  const test::TestFolder run;
  test::write_fake_run(run.path());
  for (const char* name : {"timeline.csv", "site.json"}) std::filesystem::remove(run / name);
  const Json details = run_details(run.path(), 1000);
  EXPECT_EQ(details["t"].size(), 201u);
  EXPECT_FALSE(details.contains("inliers"));
  EXPECT_TRUE(details["site"].is_null());
}

TEST(RunDetailsTest, DamagedFilesAreNamed) {
  const test::TestFolder run;
  test::write_fake_run(run.path());
  const auto spoil = [&](const std::string& name, const std::string& text) {
    const std::string whole = read_file(run / name);
    run.write(name, text);
    const std::string message = test::error_of([&] { run_details(run.path(), 1000); });
    run.write(name, whole);
    return message;
  };
  EXPECT_THAT(spoil("timeline.csv", "t,frame\n0.0,1\n"), HasSubstr("timeline.csv"));
  EXPECT_THAT(spoil("site.json", "{"), HasSubstr("site.json"));
  EXPECT_THAT(spoil("site.json", "[]"), HasSubstr("site.json"));
  EXPECT_THAT(spoil("events.jsonl", "{\"t\": 0}\n"), HasSubstr("events.jsonl:1"));
  EXPECT_THAT(spoil("estimate.tum", "0 1\n"), HasSubstr("estimate.tum"));
  EXPECT_EQ(test::error_of([&] { run_details(run.path(), 1000); }), "");
}

TEST(RunDetailsTest, KnowsFoldersOfRuns) {
  const test::TestFolder run;
  EXPECT_FALSE(is_run_folder(run.path()));
  run.write("events.jsonl", "");  // interrupted
  EXPECT_TRUE(is_run_folder(run.path()));
}

}  // namespace
}  // namespace vinebench::harness
