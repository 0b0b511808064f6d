// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/plugin_slam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/run/system_failure.h"
#include "tests/support/fakes.h"
#include "tests/support/plugins.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// In the bench's own process, and in another one.
class PluginSlamTest : public testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<SlamSystem> load(const std::string& settings = "",
                                   const char* library = "fake_plugin.so") const {
    PluginSlamConfig config{.library = test::beside_test(library), .in_process = GetParam()};
    if (!settings.empty()) config.settings = settings;
    return load_plugin_slam(config, test::fake_rig(), {}, std::nullopt, 1,
                            {test::beside_test("vinebench_plugin_host"), {}});
  }
  template <class Action>
  static std::string failure_of(const Action& action) {
    try {
      action();
    } catch (const SystemFailure& failure) {
      return failure.what();
    }
    return "";
  }
  std::string failure(const std::string& settings) const {
    return failure_of([&] {
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

INSTANTIATE_TEST_SUITE_P(InAProcess, PluginSlamTest, testing::Values(true, false),
                         [](const auto& in_process) {
                           return std::string(in_process.param ? "OfTheBench" : "OfItsOwn");
                         });

TEST_P(PluginSlamTest, AFrameGoesInAndAnEstimateComesOut) {
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

TEST_P(PluginSlamTest, ItIsToldWhenImagesWereTaken) {
  const auto slam = load();
  Frame late = frame();
  late.image_stamps = {late.stamp, late.stamp, late.stamp + 250};
  EXPECT_EQ(slam->process(late).T_map_body.value().translation.y(), 250);
  late.image_stamps.clear();
  EXPECT_EQ(slam->process(late).T_map_body.value().translation.y(), 0);
}

TEST_P(PluginSlamTest, OnesOfVersion1AreLoaded) {
  EXPECT_DOUBLE_EQ(load("", "old_plugin.so")->process(frame()).T_map_body.value().translation.x(),
                   0.290);
}

TEST_P(PluginSlamTest, WhatItSaysOfAFailureIsTheFailure) {
  for (const char* function : {"process", "finish"}) {
    EXPECT_THAT(failure(std::string("fail.") + function),
                HasSubstr(std::string("fake_plugin.so: ") + function + ": asked to fail in "));
  }
  EXPECT_THAT(failure("bad.late"), HasSubstr("finish: expected a stamp within 146 years, found 9"));
  EXPECT_THAT(failure("bad.pose"), HasSubstr("fake_plugin.so: invalid pose"));
  EXPECT_THAT(failure("bad.covariance"), HasSubstr("process: expected a finite covariance"));
}

// Such as settings that it cannot read: no frame has been processed.
TEST_P(PluginSlamTest, WhatItSaysThatItCannotCreateIsAnError) {
  EXPECT_EQ(failure_of([&] { EXPECT_THROW(load("fail.create"), Error); }), "");
  EXPECT_THAT(test::error_of([&] { load("fail.create"); }),
              HasSubstr("create: asked to fail in create"));
}

TEST_P(PluginSlamTest, WhatIsNoPluginIsAnError) {
  EXPECT_THAT(test::error_of([&] { load("", "nowhere.so"); }),
              testing::AllOf(HasSubstr("slam.plugin.library: "), HasSubstr("nowhere.so")));
  EXPECT_THAT(test::error_of([&] { load("", "empty_plugin.so"); }),
              HasSubstr("exports no vinebench_slam"));
  EXPECT_THAT(test::error_of([&] { load("", "future_plugin.so"); }),
              HasSubstr("expected version 1 to 2 of core/slam_plugin.h, found 99"));
}

TEST_P(PluginSlamTest, ItsExceptionsAreNamed) {
  const auto in_create = load("settings", "throwing_plugin.so");
  EXPECT_THAT(failure_of([&] { in_create->process(frame()); }),
              HasSubstr("throwing_plugin.so: create: threw an exception: no such vocabulary"));
  const auto slam = load("", "throwing_plugin.so");
  EXPECT_THAT(failure_of([&] { slam->process(frame()); }),
              HasSubstr("throwing_plugin.so: process: threw an exception: matrix is singular"));
  EXPECT_THAT(failure_of([&] { slam->finish(); }),
              HasSubstr("throwing_plugin.so: finish: threw what is no std::exception"));
}

TEST(PluginSlam, ANewProcessNeedsItsProgram) {
  const PluginSlamConfig config{.library = test::beside_test("fake_plugin.so")};
  EXPECT_THAT(
      test::error_of([&] { load_plugin_slam(config, test::fake_rig(), {}, std::nullopt, 1, {}); }),
      HasSubstr("vinebench_plugin_host is neither beside the program"));
}

}  // namespace
}  // namespace vinebench::harness
