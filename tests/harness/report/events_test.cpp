// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/judge/run_report.h"
#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

using test::record_of;
using Json = nlohmann::ordered_json;

std::vector<Json> events_of(const RunRecord& record, double box_share = 0.8) {
  const RunReport report = judge(record, test::fake_trial());
  std::istringstream in(format_events(record, report.results, report.diagnosis, box_share));
  std::vector<Json> list;
  for (std::string line; std::getline(in, line);) list.push_back(Json::parse(line));
  return list;
}

/// Those of one kind.
std::vector<Json> events_of(const RunRecord& record, const std::string& kind) {
  std::vector<Json> list = events_of(record);
  std::erase_if(list, [&](const Json& event) { return event["event"] != kind; });
  return list;
}

void close_loop(Estimate& estimate) {
  if (estimate.stamp != test::seconds(19)) return;
  estimate.loop_closure = test::fake_closure(test::seconds(1), test::seconds(19));
  estimate.loop_closure->correction = 0.05;
}

TEST(EventsTest, TellTheStory) {
  const std::vector<Json> events = events_of(record_of([](Estimate& estimate) {
    close_loop(estimate);
    const double t = to_seconds(estimate.stamp);
    if (t >= 9 && t <= 10) {
      estimate.status = t <= 9.5 ? TrackingStatus::kDeadReckoning : TrackingStatus::kLost;
      estimate.T_map_body.reset();
      estimate.keyframe = false;
    }
    // Ambiguous for a second, accepted for one, and misplaced for half a second.
    if (t < 1) estimate.rejected_tags = {{"tag36h11", 7, 2, TagRejection::kAmbiguous}};
    if (t >= 2 && t < 2.5) estimate.rejected_tags = {{"tag36h11", 7, 2, TagRejection::kMisplaced}};
    if (t <= 2)
      estimate.tags = {
          {.camera = 2, .family = "tag36h11", .id = 7, .corners = {}, .T_cam_tag = {}}};
  }));
  std::map<std::string, int> counts;
  double last = 0;
  for (const Json& event : events) {
    ++counts[event["event"]];
    EXPECT_GE(event["t"], last);
    last = event["t"];
    if (event["event"] == "occlusion_end") {
      EXPECT_DOUBLE_EQ(event["seconds"], 4.1);
    }
    if (event["event"] == "loop_closure") {
      EXPECT_TRUE(event["correct"]);
    }
    if (event["event"] == "tag_gone") {
      EXPECT_EQ(event["frames"], 21);
    }
    if (event["event"] == "lost") {
      EXPECT_TRUE(event["dead_reckoning"]);
    }
    if (event["event"] == "explained") {  // lost behind the carton
      EXPECT_EQ(event["cause"], "occlusion");
      EXPECT_EQ(event["from"], 9);
      EXPECT_EQ(event["until"], 10);
    }
    if (event["event"] == "tag_rejected") {
      EXPECT_EQ(event["reason"], event["frame"] == 0 ? "ambiguous" : "misplaced");
    }
  }
  const std::map<std::string, int> expected{{"initialised", 1},
                                            {"keyframe", 4},
                                            {"loop_closure", 1},
                                            {"lost", 1},
                                            {"relocalised", 1},
                                            {"occlusion_begin", 2},
                                            {"tag_gone", 1},
                                            {"occlusion_end", 2},
                                            {"tag_seen", 1},
                                            {"tag_rejected", 2},
                                            {"dead_reckoning_given_up", 1},
                                            {"explained", 1}};
  EXPECT_EQ(counts, expected);
}

TEST(EventsTest, FaultsOfTheDataNameTheirSensor) {
  RunRecord record = record_of();
  record.ticks[3].events = {{"picture_missing", "side", "no file"}};
  const auto faults = events_of(record, "picture_missing");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0]["frame"], 3);
  EXPECT_EQ(faults[0]["t"], 0.3);
  EXPECT_EQ(faults[0]["sensor"], "side");
  EXPECT_EQ(faults[0]["detail"], "no file");
}

// The tag is in view again from 18 s to the end, at 20 s.
TEST(EventsTest, AReturnWithoutAClosureIsMissed) {
  const auto missed = events_of(record_of(), "loop_closure_missed");
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_EQ(missed[0]["tag"], 7);
  EXPECT_EQ(missed[0]["t"], 20);
  EXPECT_EQ(missed[0]["seen_since_t"], 18);
  EXPECT_TRUE(events_of(record_of(close_loop), "loop_closure_missed").empty());
}

TEST(EventsTest, AClosureHasItsError) {
  const auto closures = events_of(record_of([](Estimate& estimate) {
                                    if (estimate.stamp != test::seconds(19)) return;
                                    estimate.loop_closure = test::fake_closure(
                                        test::seconds(1), test::seconds(19), 0.25);
                                  }),
                                  "loop_closure");
  ASSERT_EQ(closures.size(), 1u);
  EXPECT_NEAR(closures[0]["error_m"].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(closures[0]["error_deg"].get<double>(), 0, 1e-6);
  EXPECT_EQ(closures[0]["correct"], false);
}

// Cartons cover 95 % of the front pair.
TEST(EventsTest, OcclusionBeginsAtTheGivenShare) {
  const auto begins = [](double box_share) {
    const auto events = events_of(record_of(), box_share);
    return std::ranges::count_if(
        events, [](const Json& event) { return event["event"] == "occlusion_begin"; });
  };
  EXPECT_EQ(begins(0.95), 2);
  EXPECT_EQ(begins(0.96), 0);
}

TEST(EventsTest, TheFirstPlaceInTheWorldIsLogged) {
  const std::vector<Json> placed = events_of(record_of([](Estimate& estimate) {
                                               const double t = to_seconds(estimate.stamp);
                                               if (t < 2) return;
                                               estimate.T_world_map = Pose{{0, 0, 0, 1}, {t, 5, 6}};
                                             }),
                                             "placed");
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0]["t"], 2);
  EXPECT_EQ(placed[0]["position_m"], Json({2, 5, 6}));
  EXPECT_EQ(placed[0]["quaternion_xyzw"], Json({0, 0, 1, 0}));  // half a turn about z
}

TEST(EventsTest, ACalibrationIsLogged) {
  const auto found = events_of(record_of([](Estimate& estimate) {
                                 if (estimate.stamp == test::seconds(5)) {
                                   PairCalibration pair;
                                   pair.T_nominal_camera.translation.x() = 0.5;
                                   pair.disparity_offset = 0.25;
                                   pair.time = 0.125;
                                   pair.principal_point.x() = 0.5;
                                   pair.right_turn.z() = std::numbers::pi;
                                   estimate.calibration = {{pair}, {0.25}};
                                 }
                               }),
                               "calibrated");
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0]["pairs"].size(), 1u);
  const Json& pair = found[0]["pairs"][0];
  EXPECT_EQ(pair["disparity_offset_px"], 0.25);
  EXPECT_EQ(pair["time_s"], 0.125);
  EXPECT_EQ(found[0]["tag_times_s"], Json({0.25}));
  EXPECT_EQ(pair["principal_point_px"], Json({0.5, 0}));
  EXPECT_EQ(pair["right_turn_deg"], Json({0, 0, 180}));
  EXPECT_EQ(pair["position_m"], Json({0.5, 0, 0}));
  EXPECT_EQ(pair["rotation_deg"], Json({0, 0, 0}));
}

}  // namespace
}  // namespace vinebench::harness
