// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/recovery.h"

#include <gtest/gtest.h>

#include "slam/pipeline.h"
#include "tests/support/aisle_drive.h"

namespace vinebench::slam {
namespace {

using test::both;
using test::driving;
using test::kLandmarks;
using test::SyntheticAisle;
using test::wheels;
using test::worst_error;

TEST(RecoveryTest, RestartsByItsWheelsWhereNothingIsKnown) {
  const SyntheticAisle aisle(0.5, 8, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  std::vector<Pose> truth;
  int reckoned = 0;
  for (std::int64_t i = 0; i < 120; ++i) {
    truth.push_back(driving(i));
    const bool dark = i >= 30 && i < 60;
    auto frame = dark ? aisle.frame(i, truth.back(), {0, 1}) : aisle.frame(i, truth.back());
    // After the blackout the scene is different: nothing of the map is matched.
    if (i >= 60) {
      for (StereoView& view : frame->views) {
        for (Descriptor& d : view.features.descriptors) {
          for (std::uint64_t& word : d) word = ~word;
        }
      }
    }
    if (i > 0) frame->wheels = wheels(i, 0.02);
    const Estimate estimate = pipeline.process(frame);
    ASSERT_TRUE(estimate.T_map_body.has_value()) << i;
    reckoned += estimate.status == TrackingStatus::kDeadReckoning;
    if (i >= 63) {
      EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    }
  }
  EXPECT_GE(reckoned, 30);
  EXPECT_LE(reckoned, 33);  // plus the frames until the map was restarted after three failures
  // 0.64 m of dead reckoning with 2 % of slip: 13 mm, and little more.
  EXPECT_NEAR(worst_error(pipeline.finish().trajectory, truth), 0.013, 0.006);
}

// With covered cameras and resting wheels carried back by 0.8 m, to where it was before.
TEST(RecoveryTest, ACarriedBodyKnowsThePlaceAgain) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 120; ++i) {
    const bool dark = i >= 60 && i < 70;
    truth.push_back(driving(i < 60 ? i : dark ? 60 : i - 50));
    const auto frame = dark ? aisle.frame(i, truth.back(), {0, 1}) : aisle.frame(i, truth.back());
    if (i > 0) frame->wheels = dark || i == 70 ? WheelStep{} : wheels(i < 60 ? i : i - 50, 0);
    const Estimate estimate = pipeline.process(frame);
    // Two frames in a row have to agree.
    if (i >= 71) {
      EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    }
  }
  const SlamSummary summary = pipeline.finish();
  // What dead reckoning made of the dark frames and the one after them is withdrawn.
  EXPECT_EQ(summary.trajectory.size(), 120u - 11u);
  EXPECT_LT(worst_error(summary.trajectory, truth), 0.01);  // as DriftsLittleWithNoise
}

/// Drives on while what is seen in two frames looks like the place 4 m back, with all that the map
/// has there: neither is believed, and all others track.
void drive_deceived(std::int64_t first, std::int64_t second) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < second + 6; ++i) {
    const bool deceived = i == first || i == second;
    truth.push_back(driving(i));
    const auto frame = aisle.frame(i, deceived ? driving(i - 200) : truth.back());
    if (i > 0) frame->wheels = wheels(i, 0);
    const Estimate estimate = pipeline.process(frame);
    EXPECT_EQ(estimate.status,
              deceived ? TrackingStatus::kDeadReckoning : TrackingStatus::kTracking)
        << i;
  }
  const SlamSummary summary = pipeline.finish();
  EXPECT_EQ(summary.trajectory.size(), truth.size());
  EXPECT_LT(worst_error(summary.trajectory, truth), 0.01);  // as DriftsLittleWithNoise
}

// In between the body tracked where it is, so that it cannot have been carried.
TEST(RecoveryTest, FramesThatTrackOutdateAPlaceThatWasSeenBefore) {
  drive_deceived(230, 234);
}

// In a row, within 0.13 s since the body was tracked: nobody carries it farther than 0.1 m +
// 2 m/s * 0.13 s in that time.
TEST(RecoveryTest, NobodyIsCarriedFarInAMoment) {
  drive_deceived(230, 231);
}

/// A drive from a tag on for 30 frames; with covered cameras and resting wheels carried 2 m ahead,
/// where nothing is known; and back to the tag, where the new things are still in view.
class CarriedTest : public testing::Test {
 protected:
  /// What was seen first is in view again at the tag if `aisle_in_view`.
  SlamSummary drive(bool aisle_in_view) {
    Pipeline pipeline(SlamConfig{}, aisle_.rig, {});
    for (std::int64_t i = 0; i < 100; ++i) {
      const bool dark = i >= 30 && i < 40;
      const double x = i < 40
                           ? 0.02 * static_cast<double>(std::min<std::int64_t>(i, 29))
                           : 2.58 - 0.04 * static_cast<double>(std::min<std::int64_t>(i - 40, 62));
      truth_.push_back({Eigen::Quaterniond::Identity(), {x, 0, 0}});
      const Pose& pose = truth_.back();
      std::shared_ptr<FrameFeatures> frame = dark     ? aisle_.frame(i, pose, {0, 1})
                                             : i < 30 ? aisle_.frame(i, pose)
                                                      : elsewhere_.frame(i, pose);
      const bool sees_tag = i < 3 || i >= 95;
      if (sees_tag) {
        const auto there = aisle_.frame_with_tag(i, pose, T_world_tag_);
        if (i >= 95 && aisle_in_view) frame = both(*frame, *there, aisle_.rig);
        if (i < 3) frame = there;
        frame->tags = there->tags;
      }
      if (i > 0) {
        frame->wheels = WheelStep{};
        if (i < 30 || i > 40) frame->wheels->T_before_now.translation.x() = i < 30 ? 0.02 : -0.04;
      }
      const Estimate estimate = pipeline.process(frame);
      loops_ += estimate.loop_closure.has_value();
      rejected_ += estimate.rejected_tags.size();
    }
    return pipeline.finish();
  }

  const SyntheticAisle aisle_{0.5, 5, kLandmarks};
  const SyntheticAisle elsewhere_{0.5, 15, kLandmarks};
  const Pose T_world_tag_ =
      aisle_.rig.cameras[4].T_body_cam * Pose{exp_so3({0.1, 0.2, 0}), {0.02, 0.01, 1.0}};
  std::vector<Pose> truth_;
  int loops_ = 0;
  std::size_t rejected_ = 0;
};

TEST_F(CarriedTest, ATagThatItsPlaceBearsOutIsBelieved) {
  const SlamSummary summary = drive(true);
  EXPECT_EQ(loops_, 1);
  EXPECT_EQ(rejected_, 0u);
  // Without a pose are the ten dark frames and two more: in the third the map is restarted.
  EXPECT_EQ(summary.trajectory.size(), 100u - 12u);
  // As DriftsLittleWithNoise, over the way back to the tag.
  EXPECT_LT(worst_error(summary.trajectory, truth_), 0.01);
}

// To the estimator it is as if the tag had been carried: what is around it is not what was there.
TEST_F(CarriedTest, ATagThatItsPlaceDoesNotBearOutWasMoved) {
  drive(false);
  EXPECT_EQ(loops_, 0);
  EXPECT_GT(rejected_, 0u);
}

TEST(RecoveryTest, SaysLostWhenItKnowsTooLittle) {
  SlamConfig uncertain;
  uncertain.dead_reckoning.max_sigma = 0.01;  // m, and an acceleration of 0.5 m/s^2: 0.2 s
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(uncertain, aisle.rig, {});
  for (std::int64_t i = 0; i < 30; ++i) pipeline.process(aisle.frame(i, driving(i)));
  EXPECT_EQ(pipeline.process(aisle.frame(30, driving(30), {0, 1})).status,
            TrackingStatus::kDeadReckoning);
  pipeline.process(aisle.frame(31, driving(31), {0, 1}));
  pipeline.process(aisle.frame(32, driving(32), {0, 1}));
  const Estimate blind = pipeline.process(aisle.frame(33, driving(33), {0, 1}));
  EXPECT_EQ(blind.status, TrackingStatus::kLost);
  EXPECT_FALSE(blind.T_map_body.has_value());
}

// Three frames that show another place, ten frames apart: the map is restarted by three in a row.
TEST(RecoveryTest, FailuresApartRestartNoMap) {
  const SyntheticAisle aisle(0.5, 13, kLandmarks);
  const SyntheticAisle elsewhere(0.5, 14, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 90; ++i) {
    truth.push_back(driving(i));
    const bool strange = i == 40 || i == 50 || i == 60;
    const Estimate estimate =
        pipeline.process((strange ? elsewhere : aisle).frame(i, truth.back()));
    EXPECT_EQ(estimate.status == TrackingStatus::kTracking, !strange) << i;
    EXPECT_FALSE(strange && estimate.keyframe) << i;
  }
  // As DriftsLittleWithNoise, and a frame's velocity kept for one frame: 0.02 m with 5 % of error.
  EXPECT_LT(worst_error(pipeline.finish().trajectory, truth), 0.01);
}

TEST(RecoveryTest, FindsItselfAgainAfterTwoBlindFrames) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  for (std::int64_t i = 0; i < 30; ++i) pipeline.process(aisle.frame(i, driving(i)));
  pipeline.process(aisle.frame(30, driving(30), {0, 1}));
  // Two frames later the prediction is still valid: tracking recovers.
  pipeline.process(aisle.frame(31, driving(31), {0, 1}));
  EXPECT_EQ(pipeline.process(aisle.frame(32, driving(32))).status, TrackingStatus::kTracking);
}

}  // namespace
}  // namespace vinebench::slam
