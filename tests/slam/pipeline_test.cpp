// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/pipeline.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "core/geometry/cross_matrix.h"
#include "tests/support/aisle_drive.h"

namespace vinebench::slam {
namespace {

using test::driving;
using test::kLandmarks;
using test::SyntheticAisle;
using test::worst_error;

TEST(PipelineTest, RecoversTheWayExactlyWithoutNoise) {
  const SyntheticAisle aisle(0, 1, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
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
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
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
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
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
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  std::vector<Pose> truth(100, driving(10));
  for (std::int64_t i = 0; i < 100; ++i) pipeline.process(aisle.frame(i, truth[0]));
  const SlamSummary summary = pipeline.finish();
  EXPECT_LT(worst_error(summary.trajectory, truth), 0.001);
  EXPECT_LE(summary.keyframes.size(), 2u);
}

TEST(PipelineTest, GoesOnWhileOnePairIsBlind) {
  const SyntheticAisle aisle(0.5, 4, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
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
    if (!estimate.calibration.empty()) found = estimate.calibration.pairs;
  }
  return {found, worst_error(pipeline.finish().trajectory, truth)};
}

// The bound on the error is not derived: this drive exceeds the 8 mm allowed for noise above. The
// test checks the offset, and that the error is less than half of that without correction.
TEST(PipelineTest, FindsThatAPairsDisparitiesAreShort) {
  const auto [found, error] = drive_miscalibrated(SlamConfig{});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].disparity_offset, 0, 0.05);
  EXPECT_NEAR(found[1].disparity_offset, 0.8, 0.05);
  EXPECT_LT(error, 0.012);

  SlamConfig believing;
  believing.stereo.self_calibration = false;
  const auto [none, uncorrected] = drive_miscalibrated(believing);
  EXPECT_TRUE(none.empty());
  EXPECT_GT(uncorrected, 2 * error);
}

TEST(PipelineTest, ReckonsThroughABlackoutOfHalfASecond) {
  const SyntheticAisle aisle(0.5, 5, kLandmarks);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
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

TEST_F(RoundTripTest, TheFirstPoseIsAsSureAsWhatPlacedIt) {
  const auto covariance = [&](const SlamConfig& config, const std::vector<RegisteredTag>& tags) {
    Pipeline pipeline(config, aisle_.rig, tags);
    return pipeline.process(aisle_.frame_with_tag(0, round_trip(0), T_world_tag_)).covariance;
  };
  // The map's origin is where it is, to 1e-6 m and rad.
  EXPECT_LT((covariance({}, {}) - 1e-12 * Matrix6d::Identity()).norm(), 1e-20);
  // By a tag it is as sure as that one's corners, which are not exact.
  const std::vector<RegisteredTag> tags{{"tag36h11", 0, 0.161, T_world_tag_}};
  const Matrix6d by_corners = covariance({}, tags);
  EXPECT_GT(by_corners.ldlt().vectorD().minCoeff(), 1e-12);
  // What is told of the camera's mounting adds to it: where the camera is at c, a turn of it by
  // theta moves the body by c x theta.
  SlamConfig told;
  told.calibration.tag_camera_position = 0.003;
  told.calibration.tag_camera_rotation_deg = 0.2;
  const double turn = std::pow(0.2 * std::numbers::pi / 180, 2);
  const Eigen::Vector3d c = aisle_.rig.cameras[4].T_body_cam.translation;
  const Matrix6d of_mounting = covariance(told, tags) - by_corners;
  const Eigen::Matrix3d of_position =
      0.003 * 0.003 * Eigen::Matrix3d::Identity() +
      turn * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  EXPECT_LT((of_mounting.topLeftCorner<3, 3>() - of_position).norm(), 1e-15);
  EXPECT_LT((of_mounting.topRightCorner<3, 3>() - turn * cross_matrix(c)).norm(), 1e-15);
  EXPECT_LT((of_mounting.bottomRightCorner<3, 3>() - turn * Eigen::Matrix3d::Identity()).norm(),
            1e-15);
}

TEST_F(RoundTripTest, ARegisteredTagSeenAgainClosesTheLoop) {
  Pipeline pipeline(SlamConfig{}, aisle_.rig, {{"tag36h11", 0, 0.161, T_world_tag_}});
  drive(pipeline, T_world_tag_);
  expect_the_loop_closed();
}

TEST_F(RoundTripTest, SoDoesOneThatWasMappedAtFirstSight) {
  Pipeline pipeline(SlamConfig{}, aisle_.rig, {});
  drive(pipeline, T_world_tag_);
  expect_the_loop_closed();
}

// Live, the adjustments run beside tracking, and join when they are done. A keyframe waits for the
// local one before it, so that the loop may be closed some frames later. These frames come faster
// than any robot's: out along the aisle and back in reverse, where tracking never needs the newest
// keyframe.
TEST_F(RoundTripTest, LiveALoopIsClosedBesideTracking) {
  SlamConfig config;
  config.mapping.schedule = MappingSchedule::kLive;
  Pipeline pipeline(config, aisle_.rig, {});
  double unsure = 0, sure = 0;
  for (std::int64_t i = 0; i <= 220; ++i) {
    truth_.push_back(driving(i < 100 ? i : std::max<std::int64_t>(200 - i, 0)));
    const bool sees_tag = i < 3 || i >= 198;
    const Estimate estimate =
        pipeline.process(sees_tag ? aisle_.frame_with_tag(i, truth_.back(), T_world_tag_)
                                  : aisle_.frame(i, truth_.back()));
    ASSERT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    if (estimate.loop_closure) {
      closed_at_.push_back(i);
      // The map is not yet where the tag has it: the pose is told as it was before.
      EXPECT_GT(estimate.covariance.trace(), 0.99 * unsure);
    }
    if (closed_at_.empty()) unsure = estimate.covariance.trace();
    sure = estimate.covariance.trace();
  }
  ASSERT_EQ(closed_at_.size(), 1u);
  // The way out and back leaves more than twice as much open as the tag does.
  for (std::int64_t i = 221; sure > 0.5 * unsure; ++i) {
    ASSERT_LT(i, 3000) << "the adjustment does not join";
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    truth_.push_back(driving(0));
    sure = pipeline.process(aisle_.frame_with_tag(i, driving(0), T_world_tag_)).covariance.trace();
  }
  summary_ = pipeline.finish();
  const Pose last = summary_.trajectory[0].pose.inverse() * summary_.trajectory[220].pose;
  const Pose last_truth = truth_[0].inverse() * truth_[220];
  // As in lockstep.
  EXPECT_LT((last.translation - last_truth.translation).norm(), 0.002);
  EXPECT_LT(worst_error(summary_.trajectory, truth_), 0.01);
}

TEST_F(RoundTripTest, ATagThatWasMovedOrIsThereTwiceClosesNone) {
  // The path is about 4 m long: a drift of at most 0.13 m is accepted.
  Pose moved = T_world_tag_;
  moved.translation.x() += 0.2;
  Pipeline pipeline(SlamConfig{}, aisle_.rig, {{"tag36h11", 0, 0.161, T_world_tag_}});
  drive(pipeline, moved);
  EXPECT_TRUE(closed_at_.empty());
  EXPECT_EQ(rejected_, 2u);
  // The remaining error is the drift over 4 m with few landmarks and a pixel of noise.
  EXPECT_LT(worst_error(summary_.trajectory, truth_), 0.05);
}

// Without any tag: on the way back the back pair sees what the front pair mapped, and the other way
// about. Tracking finds it by itself; the drive out and back is 4 m, of which two are away.
TEST(PipelineTest, APlaceThatIsSeenAgainClosesTheLoop) {
  const SyntheticAisle aisle(0.5, 6, 900);
  SlamConfig config;
  config.places.emplace().away_distance = 2;
  Pipeline pipeline(config, aisle.rig, {});
  std::vector<LoopClosure> closures;
  for (std::int64_t i = 0; i < 261; ++i) {
    const Estimate estimate = pipeline.process(aisle.frame(i, round_trip(i)));
    ASSERT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    if (estimate.loop_closure) closures.push_back(*estimate.loop_closure);
  }
  ASSERT_EQ(closures.size(), 1u);
  EXPECT_EQ(closures[0].tag_id, -1);
  const auto truth = [](Stamp stamp) { return round_trip(std::lround(to_seconds(stamp) * 15)); };
  const Pose moved = truth(closures[0].earlier).inverse() * truth(closures[0].later);
  // Half a pixel is 2 mm for one feature at a metre.
  EXPECT_LT((closures[0].T_earlier_later.translation - moved.translation).norm(), 0.002);
}

TEST(PipelineTest, ATagSeenOnlyBetweenKeyframesIsNoLoopYet) {
  const SyntheticAisle aisle(0.5, 8, kLandmarks);
  const RigCamera& side = aisle.rig.cameras[4];
  const Pose T_cam_tag{exp_so3({0.1, 0.2, 0}), {0.02, 0.01, 2.0}};
  const Pose T_world_tag = driving(1) * side.T_body_cam * T_cam_tag;
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
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

// The world is not the map's first pose: it is a metre and a quarter turn away. The tag is in view
// from frame 3 on.
TEST(PipelineTest, PosesAreToldInTheWorldFromTheFirstRegisteredTagOn) {
  const SyntheticAisle aisle(0.5, 8, kLandmarks);
  const Pose T_cam_tag{exp_so3({0.1, 0.2, 0}), {0.02, 0.01, 2.0}};
  const Pose T_start_tag = driving(3) * aisle.rig.cameras[4].T_body_cam * T_cam_tag;
  const Pose T_world_start{exp_so3({0, 0, std::numbers::pi / 2}), {1, 0, 0.2}};
  Pipeline pipeline(SlamConfig{}, aisle.rig, {{"tag36h11", 0, 0.161, T_world_start * T_start_tag}});
  for (std::int64_t i = 0; i < 8; ++i) {
    const Estimate estimate = pipeline.process(
        i >= 3 ? aisle.frame_with_tag(i, driving(i), T_start_tag) : aisle.frame(i, driving(i)));
    ASSERT_EQ(estimate.T_world_map.has_value(), i >= 3) << i;
    if (i < 3) continue;
    const Pose T_world_body = *estimate.T_world_map * *estimate.T_map_body;
    const Pose truth = T_world_start * driving(0).inverse() * driving(i);
    EXPECT_LT((T_world_body.translation - truth.translation).norm(), 0.005) << i;  // m, at 2 m
    EXPECT_LT(T_world_body.rotation.angularDistance(truth.rotation), 0.003) << i;  // rad, likewise
  }
}

TEST(PipelineTest, SameInputSameBits) {
  const SyntheticAisle aisle(0.5, 7, kLandmarks);
  std::string texts[2];
  for (std::string& text : texts) {
    Pipeline pipeline(SlamConfig{}, aisle.rig, {});
    for (std::int64_t i = 0; i < 40; ++i) pipeline.process(aisle.frame(i, driving(i)));
    for (const StampedPose& p : pipeline.finish().trajectory) {
      text.append(reinterpret_cast<const char*>(p.pose.translation.data()), 24);
    }
  }
  EXPECT_EQ(texts[0], texts[1]);
}

}  // namespace
}  // namespace vinebench::slam
