// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/pipeline.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_aisle.h"

namespace vinebench::slam {
namespace {

using test::SyntheticAisle;

/// Landmarks of the aisle: more than 100 in view of each pair, and fast.
constexpr int kLandmarks = 1500;

SlamConfig config() {
  return {};
}

/// Drives along x, swaying a little in heading; 0.3 m/s where a frame is 0.02 m.
Pose driving(std::int64_t frame, double step = 0.02) {
  const double x = step * static_cast<double>(frame);
  return {exp_so3({0, 0, 0.1 * std::sin(2.0 * x)}), {x, 0.05 * std::sin(x), 0}};
}

/// Largest position error against the truth of the same frame, both relative to the first one, m.
double worst_error(const Trajectory& estimate, const std::vector<Pose>& truth) {
  double worst = 0;
  for (const StampedPose& at : estimate) {
    const auto frame = static_cast<std::size_t>(std::lround(to_seconds(at.stamp) * 15));
    const Pose moved = estimate.front().pose.inverse() * at.pose;
    const Pose moved_truth = truth.front().inverse() * truth[frame];
    worst = std::max(worst, (moved.translation - moved_truth.translation).norm());
  }
  return worst;
}

TEST(PipelineTest, RecoversTheWayExactlyWithoutNoise) {
  const SyntheticAisle aisle(0, 1, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 60; ++i) {
    truth.push_back(driving(i));
    ASSERT_EQ(pipeline.process(aisle.frame(i, truth.back())).status, TrackingStatus::kTracking)
        << i;
  }
  const SlamSummary summary = pipeline.finish();
  ASSERT_EQ(summary.trajectory.size(), 60u);
  // Pixels are held as floats, 3e-5 px at 500: about 1e-7 m a frame at half a metre.
  EXPECT_LT(worst_error(summary.trajectory, truth), 2e-6);
}

TEST(PipelineTest, TellsWhichFeaturesSupportThePose) {
  const SyntheticAisle aisle(0, 1, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  EXPECT_TRUE(pipeline.supporting_features().empty());
  Estimate estimate;
  for (std::int64_t i = 0; i < 10; ++i) estimate = pipeline.process(aisle.frame(i, driving(i)));
  std::vector<int> counts(estimate.cameras.size());
  for (const SupportingFeature& feature : pipeline.supporting_features()) {
    ++counts.at(static_cast<std::size_t>(feature.camera));
    const RectifiedPair& pair = aisle.rig.pairs[0];
    EXPECT_TRUE(pair.lens.contains(feature.pixel));
  }
  // As many as the estimate counts, in the left cameras alone.
  for (std::size_t i = 0; i < counts.size(); ++i) {
    EXPECT_GE(counts[i], estimate.cameras[i].inliers) << i;
    EXPECT_EQ(counts[i] > 0, estimate.cameras[i].inliers > 0) << i;
  }
}

TEST(PipelineTest, DriftsLittleWithNoise) {
  const SyntheticAisle aisle(0.5, 2, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 200; ++i) {
    truth.push_back(driving(i));
    ASSERT_EQ(pipeline.process(aisle.frame(i, truth.back())).status, TrackingStatus::kTracking);
  }
  const SlamSummary summary = pipeline.finish();
  // A path of 4 m; half a pixel at half a metre is 1 mm for one feature, 0.03 mm for a thousand. A
  // random walk over some 20 keyframe chains and its heading's lever stay within 0.2 % of the path.
  EXPECT_LT(worst_error(summary.trajectory, truth), 0.008);
  EXPECT_GT(summary.landmarks, 500u);
}

TEST(PipelineTest, StandingStillStays) {
  const SyntheticAisle aisle(0.5, 3, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  std::vector<Pose> truth(100, driving(10));
  for (std::int64_t i = 0; i < 100; ++i) pipeline.process(aisle.frame(i, truth[0]));
  const SlamSummary summary = pipeline.finish();
  EXPECT_LT(worst_error(summary.trajectory, truth), 0.001);
  EXPECT_LE(summary.keyframes.size(), 2u);
}

TEST(PipelineTest, GoesOnWhileOnePairIsBlind) {
  const SyntheticAisle aisle(0.5, 4, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 120; ++i) {
    truth.push_back(driving(i));
    const bool blind = i >= 40 && i < 85;
    const Estimate estimate =
        pipeline.process(blind ? aisle.frame(i, truth.back(), {0}) : aisle.frame(i, truth.back()));
    ASSERT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    if (blind) {
      EXPECT_EQ(estimate.cameras[0].inliers, 0);
    }
    EXPECT_GT(estimate.cameras[2].inliers, 100) << i;
  }
  EXPECT_LT(worst_error(pipeline.finish().trajectory, truth), 0.01);
}

/// The last calibration found in a drive of 3.6 m whose second pair has disparities 0.8 px too
/// small, and its largest error, m.
std::pair<std::vector<PairCalibration>, double> drive_miscalibrated(const SlamConfig& settings) {
  SyntheticAisle aisle(0.5, 9, kLandmarks);
  aisle.calibration[1].disparity_offset = 0.8;
  Pipeline pipeline(settings, aisle.rig, {});
  std::vector<Pose> truth;
  std::vector<PairCalibration> found;
  for (std::int64_t i = 0; i < 90; ++i) {
    truth.push_back(driving(i, 0.04));
    const Estimate estimate = pipeline.process(aisle.frame(i, truth.back()));
    if (!estimate.calibration.empty()) found = estimate.calibration;
  }
  return {found, worst_error(pipeline.finish().trajectory, truth)};
}

// The bound on the error is not derived: this drive exceeds the 8 mm allowed for noise above. The
// test checks the offset, and that the error is less than half of that without correction.
TEST(PipelineTest, FindsThatAPairsDisparitiesAreShort) {
  const auto [found, error] = drive_miscalibrated(config());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].disparity_offset, 0, 0.05);
  EXPECT_NEAR(found[1].disparity_offset, 0.8, 0.05);
  EXPECT_LT(error, 0.012);

  SlamConfig believing = config();
  believing.stereo.self_calibration = false;
  const auto [none, uncorrected] = drive_miscalibrated(believing);
  EXPECT_TRUE(none.empty());
  EXPECT_GT(uncorrected, 2 * error);
}

/// Wheel readings of a frame's motion with the given slip.
WheelStep wheels(std::int64_t frame, double slip) {
  Pose step = driving(frame - 1).inverse() * driving(frame);
  step.translation *= 1 + slip;
  return {step, 1.0 / 15};
}

TEST(PipelineTest, ReckonsThroughABlackoutOfHalfASecond) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 80; ++i) {
    truth.push_back(driving(i, 0.4 / 15));  // 0.4 m/s
    const bool dark = i >= 40 && i < 48;    // 0.53 s at 15 Hz
    const auto frame = dark ? aisle.frame(i, truth.back(), {0, 1}) : aisle.frame(i, truth.back());
    const Estimate estimate = pipeline.process(frame);
    EXPECT_EQ(estimate.status, dark ? TrackingStatus::kDeadReckoning : TrackingStatus::kTracking)
        << i;
    ASSERT_TRUE(estimate.T_map_body.has_value());
    if (i == 47) {
      // Unobserved acceleration of 0.5 m/s^2: 0.07 m after 0.53 s.
      EXPECT_NEAR(std::sqrt(estimate.covariance(0, 0)), 0.07, 0.01);
    }
  }
  // The path sways by 2 cm in half a second: at most that during the blackout, millimetres after
  // it.
  EXPECT_LT(worst_error(pipeline.finish().trajectory, truth), 0.02);
}

TEST(PipelineTest, RestartsByItsWheelsWhereNothingIsKnown) {
  const SyntheticAisle aisle(0.5, 8, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
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
TEST(PipelineTest, ACarriedBodyKnowsThePlaceAgain) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
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

/// What both frames see.
std::shared_ptr<FrameFeatures> both(FrameFeatures a, const FrameFeatures& b, const StereoRig& rig) {
  for (std::size_t v = 0; v < a.views.size(); ++v) {
    Features& features = a.views[v].features;
    const Features& more = b.views[v].features;
    features.keypoints.insert(features.keypoints.end(), more.keypoints.begin(),
                              more.keypoints.end());
    features.descriptors.insert(features.descriptors.end(), more.descriptors.begin(),
                                more.descriptors.end());
    a.views[v].stereo.insert(a.views[v].stereo.end(), b.views[v].stereo.begin(),
                             b.views[v].stereo.end());
    a.views[v].grid =
        FeatureGrid(features.keypoints, rig.pairs[v].lens.width, rig.pairs[v].lens.height);
  }
  return std::make_shared<FrameFeatures>(std::move(a));
}

/// A drive from a tag on for 30 frames; with covered cameras and resting wheels carried 2 m ahead,
/// where nothing is known; and back to the tag, where the new things are still in view.
class CarriedTest : public testing::Test {
 protected:
  /// What was seen first is in view again at the tag if `aisle_in_view`.
  SlamSummary drive(bool aisle_in_view) {
    Pipeline pipeline(config(), aisle_.rig, {});
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

TEST(PipelineTest, SaysLostWhenItKnowsTooLittle) {
  SlamConfig uncertain = config();
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
TEST(PipelineTest, FailuresApartRestartNoMap) {
  const SyntheticAisle aisle(0.5, 13, kLandmarks);
  const SyntheticAisle elsewhere(0.5, 14, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
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

TEST(PipelineTest, FindsItselfAgainAfterTwoBlindFrames) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(config(), aisle.rig, {});
  for (std::int64_t i = 0; i < 30; ++i) pipeline.process(aisle.frame(i, driving(i)));
  pipeline.process(aisle.frame(30, driving(30), {0, 1}));
  // Two frames later the prediction is still valid: tracking recovers.
  pipeline.process(aisle.frame(31, driving(31), {0, 1}));
  EXPECT_EQ(pipeline.process(aisle.frame(32, driving(32))).status, TrackingStatus::kTracking);
}

/// 2 m forward, 2 m back (turned round, so that the map cannot be reused): the tag has to correct
/// the drift.
Pose there_and_back(std::int64_t frame) {
  if (frame < 100) return driving(frame);
  if (frame < 160) {
    const Pose turn{exp_so3({0, 0, 3.14159265 * static_cast<double>(frame - 100) / 60}),
                    Eigen::Vector3d::Zero()};
    return driving(100) * turn;
  }
  const Pose end = driving(100 - (frame - 160));
  return end * Pose{exp_so3({0, 0, 3.14159265}), Eigen::Vector3d::Zero()};
}

/// The round trip: there, back, then a rotation at the start until the side camera sees the tag
/// again.
Pose round_trip(std::int64_t frame) {
  const Pose pose = there_and_back(std::min<std::int64_t>(frame, 260));
  if (frame <= 260) return pose;
  const double turned = 3.14159265 * static_cast<double>(frame - 260) / 60;
  return pose * Pose{exp_so3({0, 0, turned}), Eigen::Vector3d::Zero()};
}

constexpr std::int64_t kReturn = 319;  // frame from which on the tag is in view again

/// A round trip that begins and ends in front of a tag.
class RoundTripTest : public testing::Test {
 protected:
  /// The tag is at T_world_tag_ at the beginning and at `later` at the end.
  void drive(Pipeline& pipeline, const Pose& later) {
    for (std::int64_t i = 0; i <= kReturn + 1; ++i) {
      truth_.push_back(round_trip(i));
      const bool sees_tag = i < 3 || i >= kReturn;
      const Estimate estimate = pipeline.process(
          sees_tag ? aisle_.frame_with_tag(i, truth_.back(), i < 3 ? T_world_tag_ : later)
                   : aisle_.frame(i, truth_.back()));
      ASSERT_EQ(estimate.status, TrackingStatus::kTracking) << i;
      rejected_ += estimate.rejected_tags.size();
      if (!estimate.loop_closure) continue;
      closed_at_.push_back(i);
      closure_ = *estimate.loop_closure;
    }
    summary_ = pipeline.finish();
  }

  void expect_the_loop_closed() const {
    EXPECT_EQ(closed_at_, std::vector<std::int64_t>{kReturn + 1});  // the second consecutive one
    const Pose moved = truth_[0].inverse() * truth_[kReturn + 1];
    EXPECT_LT((closure_.T_earlier_later.translation - moved.translation).norm(), 1e-6);
    EXPECT_EQ(rejected_, 0u);
    // Exact tag corners at both ends: the last pose is as good as the first, to the few tenths of a
    // millimetre by which features outweigh eight corners.
    const Pose last = summary_.trajectory.front().pose.inverse() * summary_.trajectory.back().pose;
    const Pose last_truth = truth_.front().inverse() * truth_.back();
    EXPECT_LT((last.translation - last_truth.translation).norm(), 0.002);
    EXPECT_LT(worst_error(summary_.trajectory, truth_), 0.01);
  }

  const SyntheticAisle aisle_{1.0, 6, 900};  // many frames: fewer landmarks still
  const Pose T_world_tag_ = round_trip(0) * aisle_.rig.cameras[4].T_body_cam *
                            Pose{exp_so3({0.1, 0.2, 0}), {0.02, 0.01, 0.3}};
  std::vector<Pose> truth_;
  std::vector<std::int64_t> closed_at_;
  LoopClosure closure_;
  std::size_t rejected_ = 0;
  SlamSummary summary_;
};

TEST_F(RoundTripTest, ARegisteredTagSeenAgainClosesTheLoop) {
  Pipeline pipeline(config(), aisle_.rig, {{"tag36h11", 0, 0.161, T_world_tag_}});
  drive(pipeline, T_world_tag_);
  expect_the_loop_closed();
}

TEST_F(RoundTripTest, SoDoesOneThatWasMappedAtFirstSight) {
  Pipeline pipeline(config(), aisle_.rig, {});
  drive(pipeline, T_world_tag_);
  expect_the_loop_closed();
}

TEST_F(RoundTripTest, ATagThatWasMovedOrIsThereTwiceClosesNone) {
  // The path is about 4 m long: a drift of at most 0.13 m is accepted.
  Pose moved = T_world_tag_;
  moved.translation.x() += 0.2;
  Pipeline pipeline(config(), aisle_.rig, {{"tag36h11", 0, 0.161, T_world_tag_}});
  drive(pipeline, moved);
  EXPECT_TRUE(closed_at_.empty());
  EXPECT_EQ(rejected_, 2u);
  // The remaining error is the drift over 4 m with few landmarks and a pixel of noise.
  EXPECT_LT(worst_error(summary_.trajectory, truth_), 0.05);
}

TEST(PipelineTest, ATagSeenOnlyBetweenKeyframesIsNoLoopYet) {
  const SyntheticAisle aisle(0.5, 8, kLandmarks);
  const RigCamera& side = aisle.rig.cameras[4];
  const Pose T_cam_tag{exp_so3({0.1, 0.2, 0}), {0.02, 0.01, 2.0}};
  const Pose T_world_tag = driving(1) * side.T_body_cam * T_cam_tag;
  Pipeline pipeline(config(), aisle.rig, {});
  // Frame 1 is too soon after the first keyframe to be one; frame 70 is 4.6 s and 1.4 m later.
  for (std::int64_t i = 0; i < 75; ++i) {
    const bool sees_tag = i == 1 || i >= 70;
    const Estimate estimate = pipeline.process(
        sees_tag ? aisle.frame_with_tag(i, driving(i), T_world_tag) : aisle.frame(i, driving(i)));
    ASSERT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    EXPECT_EQ(estimate.keyframe && i == 1, false);
    EXPECT_FALSE(estimate.loop_closure) << i;
  }
}

TEST(PipelineTest, SameInputSameBits) {
  const SyntheticAisle aisle(0.5, 7, kLandmarks);
  std::string texts[2];
  for (std::string& text : texts) {
    Pipeline pipeline(config(), aisle.rig, {});
    for (std::int64_t i = 0; i < 40; ++i) pipeline.process(aisle.frame(i, driving(i)));
    for (const StampedPose& p : pipeline.finish().trajectory) {
      text.append(reinterpret_cast<const char*>(p.pose.translation.data()), 24);
    }
  }
  EXPECT_EQ(texts[0], texts[1]);
}

}  // namespace
}  // namespace vinebench::slam
