// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/run_record.h"

#include <gmock/gmock.h>

namespace vinebench::harness {
namespace {

using testing::ElementsAre;

Pose at(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0, 0}};
}

Sample sample(std::int64_t index, double x) {
  Sample sample;
  sample.frame.index = index;
  sample.frame.stamp = 100 * index;
  sample.frame.images = {cv::Mat(1, 1, CV_8UC1), cv::Mat()};
  sample.truth.T_world_body = at(x);
  return sample;
}

TEST(RunRecordTest, KeepsWhatEachTickLeaves) {
  RunRecorder recorder({}, {});
  Estimate estimate;
  estimate.status = TrackingStatus::kTracking;
  estimate.T_map_body = at(1);
  recorder.on_tick(sample(0, 2), estimate);
  estimate.status = TrackingStatus::kDeadReckoning;
  recorder.on_tick(sample(1, 5), estimate);
  recorder.on_finish({});
  const RunRecord& record = recorder.record();
  ASSERT_EQ(record.ticks.size(), 2u);
  EXPECT_THAT(record.ticks[0].delivered, ElementsAre(true, false));
  EXPECT_EQ(true_trajectory(record).size(), 2u);
  EXPECT_EQ(live_trajectory(record).size(), 1u);  // dead reckoning is no tracking
}

// Rows 0 and 4 of five count, 4 codes each; row 1 does not.
TEST(RunRecordTest, BrightnessIsThatOfEveryFourthRow) {
  cv::Mat image(5, 4, CV_8UC1, cv::Scalar(100));
  image.at<std::uint8_t>(0, 0) = 63;
  image.at<std::uint8_t>(0, 1) = 64;
  image.at<std::uint8_t>(4, 0) = 250;
  image.at<std::uint8_t>(4, 1) = 255;
  image.at<std::uint8_t>(4, 2) = 249;
  image.row(1) = 0;
  EXPECT_DOUBLE_EQ(brightness_of(image).dark, 1.0 / 8);
  EXPECT_DOUBLE_EQ(brightness_of(image).saturated, 2.0 / 8);
  EXPECT_EQ(brightness_of(cv::Mat()).dark, 0);
  EXPECT_EQ(brightness_of(cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 0, 255))).dark, 2.0 / 3);
}

TEST(RunRecordTest, PathLengthsPassOverUnknownPoses) {
  RunRecord record;
  record.ticks.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    record.ticks[i].truth.T_world_body = at(static_cast<double>(i * i));
    record.ticks[i].truth.known = i != 2;
  }
  // At 0, 1, unknown, 9 m.
  EXPECT_THAT(true_path_lengths(record), ElementsAre(0, 1, 1, 9));
}

TEST(RunRecordTest, ASystemThatAnswersAtTheEndHasThePosesOfItsTrajectory) {
  RunRecorder recorder({}, {});
  for (int i = 0; i < 4; ++i) recorder.on_tick(sample(i, 0), {});
  SlamSummary summary;
  summary.trajectory = {{100, at(7)}, {300, at(8)}};
  recorder.on_finish(summary);
  const std::vector<Tick>& ticks = recorder.record().ticks;
  EXPECT_FALSE(ticks[0].estimate.T_map_body);
  EXPECT_EQ(ticks[0].estimate.status, TrackingStatus::kInitializing);
  EXPECT_EQ(ticks[1].estimate.T_map_body->translation.x(), 7);
  EXPECT_EQ(ticks[2].estimate.status, TrackingStatus::kLost);
  EXPECT_EQ(ticks[3].estimate.T_map_body->translation.x(), 8);
}

}  // namespace
}  // namespace vinebench::harness
