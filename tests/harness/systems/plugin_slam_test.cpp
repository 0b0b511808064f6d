// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/plugin_slam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// tests/harness/systems/fake_plugin.c, beside this program.
std::filesystem::path library(const char* name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

class PluginSlamTest : public testing::Test {
 protected:
  std::unique_ptr<SlamSystem> load(const std::string& settings = "") {
    PluginSlamConfig config{library("fake_plugin.so"), std::nullopt};
    if (!settings.empty()) config.settings = settings;
    return load_plugin_slam(config, test::fake_rig(), {}, std::nullopt, 1);
  }
  std::string error(const std::string& settings) {
    return test::error_of([&] {
      const auto slam = load(settings);
      slam->process(frame());
      slam->finish();
    });
  }
  /// Three images of 8 x 6 pixels, one of them missing, and two inertial samples.
  static Frame frame() {
    Frame frame = test::FakeSource().next()->frame;
    frame.images[1].release();
    frame.imu.resize(2);
    return frame;
  }
};

TEST_F(PluginSlamTest, AFrameGoesInAndAnEstimateComesOut) {
  const auto slam = load();
  const Estimate estimate = slam->process(frame());
  EXPECT_EQ(estimate.status, TrackingStatus::kTracking);
  EXPECT_TRUE(estimate.keyframe);
  // 2 images of 8 x 6 x 3 bytes and 2 samples are 290.
  EXPECT_DOUBLE_EQ(estimate.T_map_body.value().translation.x(), 0.290);
  ASSERT_EQ(estimate.cameras.size(), 3u);
  EXPECT_EQ(estimate.cameras[2].inliers, 3);
  EXPECT_FALSE(estimate.loop_closure);
  const SlamSummary summary = slam->finish();
  ASSERT_EQ(summary.trajectory.size(), 1u);
  EXPECT_EQ(summary.trajectory[0].stamp, estimate.stamp);
  EXPECT_EQ(summary.keyframes.size(), 1u);
  EXPECT_EQ(summary.landmarks, 5u);
  EXPECT_EQ(slam->times().samples().at("fake").size(), 1u);
}

TEST_F(PluginSlamTest, WhatItSaysOfAFailureIsTheError) {
  for (const char* function : {"create", "process", "finish"}) {
    EXPECT_THAT(error(std::string("fail.") + function),
                HasSubstr(std::string(function) + ": asked to fail in " + function));
  }
  EXPECT_THAT(error("bad.pose"), HasSubstr("fake_plugin.so: invalid pose"));
}

TEST_F(PluginSlamTest, WhatIsNoPluginIsAnError) {
  const auto error_with = [](const std::filesystem::path& file) {
    return test::error_of([&] {
      load_plugin_slam({file, std::nullopt}, test::fake_rig(), {}, std::nullopt, 1);
    });
  };
  EXPECT_THAT(error_with("/nowhere.so"), HasSubstr("slam.plugin.library: /nowhere.so"));
  EXPECT_THAT(error_with(library("empty_plugin.so")), HasSubstr("exports no vinebench_slam"));
  EXPECT_THAT(error_with(library("future_plugin.so")),
              HasSubstr("expected version 1 of core/slam_plugin.h, found 99"));
}

}  // namespace
}  // namespace vinebench::harness
