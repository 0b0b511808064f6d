// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/pose_covariance.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

const Matrix6d kUnsure = 1e-2 * Matrix6d::Identity();
const Matrix6d kSure = 1e-6 * Matrix6d::Identity();
const Eigen::MatrixXd kNoDrift = Eigen::MatrixXd::Zero(6, 1);
const Eigen::MatrixXd kExact = Eigen::MatrixXd::Zero(1, 1);
const Pose kStride{exp_so3({0, 0, 0.1}), {0.3, 0.02, 0}};

TrackedFrame seen(double information) {
  TrackedFrame frame;
  frame.tracked = true;
  frame.motion.information = information * Matrix6d::Identity();
  return frame;
}

// Nothing of a covariance is computed anew, but for the sum with zeros.
void expect_same(const Matrix6d& a, const Matrix6d& b) {
  EXPECT_LT((a - b).norm(), 1e-15);
}

TEST(PoseCovarianceTest, InLockstepALoopMakesThePoseSurerAtOnce) {
  PoseCovariance covariance(false);
  covariance.begin(kUnsure);
  covariance.close(kSure);
  expect_same(covariance.of_keyframe(kExact), kSure);
  covariance.join();
  expect_same(covariance.of_keyframe(kExact), kSure);
}

TEST(PoseCovarianceTest, LiveALoopMakesThePoseSurerWhenItsAdjustmentJoins) {
  PoseCovariance covariance(true);
  covariance.begin(kUnsure);
  covariance.join();  // another adjustment
  covariance.close(kSure);
  expect_same(covariance.of_keyframe(kExact), kUnsure);
  covariance.join();
  expect_same(covariance.of_keyframe(kExact), kSure);
}

// What comes after a loop adds to both: live and joined it is what lockstep has.
TEST(PoseCovarianceTest, LiveKeyframesAfterALoopCount) {
  PoseCovariance live(true), lockstep(false);
  for (PoseCovariance* of : {&live, &lockstep}) {
    of->begin(kUnsure);
    of->add_keyframe(kStride, seen(1e4), kNoDrift);
    of->close(kSure);
    of->add_keyframe(kStride, seen(1e4), kNoDrift);
  }
  EXPECT_GT(live.of_keyframe(kExact)(0, 0), 1e-2);
  live.join();
  expect_same(live.of_keyframe(kExact), lockstep.of_keyframe(kExact));
  EXPECT_LT(live.of_keyframe(kExact)(0, 0), 1e-4);
}

// Two that say the same are half as unsure in their mean.
TEST(PoseCovarianceTest, AnIndependentLoopAddsToWhatIsKnown) {
  PoseCovariance covariance(false);
  covariance.begin(kUnsure);
  covariance.close_besides(kUnsure);
  expect_same(covariance.of_keyframe(kExact), kUnsure / 2);
}

// A calibration's number of deviation 2 that moves the frame by 1 mm, and what its velocity leaves
// open: in a keyframe and any other.
TEST(PoseCovarianceTest, AFrameAddsWhatTheTimesOfItsImagesLeaveOpen) {
  PoseCovariance covariance(false);
  covariance.begin(kSure);
  ErrorOfImageTimes times;
  times.by_calibration = 1e-3 * Eigen::MatrixXd::Identity(6, 1);
  times.by_velocity = 1e-5 * Matrix6d::Identity();
  const Eigen::MatrixXd error = Eigen::MatrixXd::Constant(1, 1, 4);
  Matrix6d more = times.by_velocity;
  more(0, 0) += 4e-6;
  expect_same(covariance.of_keyframe(error, times), kSure + more);
  expect_same(covariance.of_frame({}, seen(1e4), error, times),
              covariance.of_frame({}, seen(1e4), error) + more);
}

TEST(PoseCovarianceTest, AFrameAddsWhatItsMotionLeavesOpen) {
  PoseCovariance covariance(false);
  covariance.begin(kSure);
  const Matrix6d known = covariance.of_frame({}, seen(1e4), kExact);
  // The share that counts of the inverse of 1e4.
  expect_same(known, kSure + PoseUncertainty::kInflation * 1e-4 * Matrix6d::Identity());
  TrackedFrame reckoned = seen(1e4);
  reckoned.tracked = false;  // its motion says nothing
  expect_same(covariance.of_frame({}, reckoned, kExact), kSure);
}

// A gap's own covariance takes the place of what its end sees.
TEST(PoseCovarianceTest, AcrossAGapTheLinksCovarianceCounts) {
  PoseCovariance covariance(false);
  covariance.begin(Matrix6d::Zero());
  TrackedFrame after = seen(1e4);
  after.link = OdometryLink{};
  after.link->covariance = kUnsure;
  covariance.add_keyframe({}, after, kNoDrift);
  expect_same(covariance.of_keyframe(kExact), kUnsure);
}

// A calibration's error of 0.5, by which each keyframe moves 2 mm ahead: 3 mm after three.
TEST(PoseCovarianceTest, ErrorsOfTheCalibrationAddUpInALine) {
  PoseCovariance covariance(false);
  covariance.begin(Matrix6d::Zero());
  Eigen::MatrixXd drift = kNoDrift;
  drift(0, 0) = 2e-3;
  for (int k = 0; k < 3; ++k) covariance.add_keyframe({}, seen(1e12), drift);
  const Eigen::MatrixXd error = Eigen::MatrixXd::Constant(1, 1, 0.25);
  EXPECT_NEAR(covariance.of_keyframe(error)(0, 0), 9e-6, 1e-9);
}

}  // namespace
}  // namespace vinebench::slam
