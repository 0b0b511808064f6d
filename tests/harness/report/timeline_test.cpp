// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(TimelineTest, HasALineAFrame) {
  RunRecord record = test::record_of([](Estimate& estimate) {
    estimate.covariance.diagonal() << 1e-4, 4e-4, 9e-4, 0, 0, 0;
    if (estimate.stamp == test::seconds(1)) {
      estimate.T_map_body.reset();
      estimate.status = TrackingStatus::kLost;
    }
  });
  const std::vector<std::string> lines = lines_of(format_timeline(record));
  ASSERT_EQ(lines.size(), 202u);
  EXPECT_EQ(lines[0],
            "t,frame,status,keyframe,xx,xy,xz,yy,yz,zz,features:front_left,features:front_right,"
            "features:side,inliers:front_left,inliers:front_right,inliers:side,"
            "occluded:front_left,occluded:front_right,occluded:side");
  // The map is the body at the start, where the body's covariance is the map's.
  EXPECT_EQ(lines[1], "0.000000000,0,tracked,1,0.0001,0,0,0.0004,0,0.0009,500,500,0,80,80,0,0,0,0");
  EXPECT_EQ(lines[11], "1.000000000,10,lost,0,nan,nan,nan,nan,nan,nan,500,500,0,80,80,0,0,0,0");
  EXPECT_THAT(lines[101], testing::EndsWith(",0.95,0.95,0"));  // 10 s: behind the carton
}

TEST(TimelineTest, TurnsTheCovarianceIntoTheMap) {
  RunRecord record = test::record_of(
      [](Estimate& estimate) { estimate.covariance.diagonal() << 1e-4, 4e-4, 9e-4, 0, 0, 0; });
  // After 5 s of 20 the body has turned by 90 degrees: its x axis is the map's y axis.
  EXPECT_THAT(
      lines_of(format_timeline(record))[51],
      testing::ContainsRegex("^5.000000000,50,tracked,1,0.0004,[-0-9.e]+,0,0.0001,0,0.0009"));
}

TEST(TimelineTest, NamesWithCommasAreQuoted) {
  RunRecord record = test::record_of();
  record.rig.cameras[0].name = "left, \"old\"";
  EXPECT_THAT(format_timeline(record), testing::HasSubstr(",\"features:left, \"\"old\"\"\","));
}

TEST(TimelineTest, TheSiteHasWhatADrawingNeeds) {
  const Trial trial = test::fake_trial();
  const auto site = site_json(trial.site, test::fake_rig());
  EXPECT_EQ(site["rows"][0], (nlohmann::ordered_json{-1.0, 1.5, 1.0, 1.5}));
  EXPECT_EQ(site["tags"][0]["id"], 7);
  EXPECT_EQ(site["objects"][0]["class"], "carton");
  EXPECT_EQ(site["cameras"].size(), 3u);
  EXPECT_EQ(site["cameras"][2]["name"], "side");
  EXPECT_EQ(site["cameras"][0]["T_body_cam"][2], 0.5);  // 0.5 m above the body's origin
}

}  // namespace
}  // namespace vinebench::harness
