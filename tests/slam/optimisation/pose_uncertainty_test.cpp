// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/pose_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/step_covariance.h"
#include "slam/factors/reprojection.h"

namespace vinebench::slam {
namespace {

Pose sample_step() {
  return {exp_so3({0.1, -0.2, 0.5}), {0.4, -0.1, 0.2}};
}

TEST(PoseUncertaintyTest, GrowsFromKeyframeToKeyframe) {
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  const Matrix6d information = 1e6 * Matrix6d::Identity();
  const Matrix6d one = PoseUncertainty::kInflation * 1e-6 * Matrix6d::Identity();
  EXPECT_LT((uncertainty.at({}, information) - one).norm(), 1e-18);
  const Pose turn{exp_so3({0.1, -0.2, 0.5}), {0, 0, 0}};
  uncertainty.keyframe(turn, information, Eigen::MatrixXd::Zero(6, 0));
  uncertainty.keyframe({}, information, Eigen::MatrixXd::Zero(6, 0));
  EXPECT_LT((uncertainty.at({}, Matrix6d::Zero()) - 2 * one).norm(), 1e-18);
  // A heading's error of variance v gives a point 2 m ahead the lateral variance 4 v.
  const Matrix6d ahead =
      uncertainty.at({Eigen::Quaterniond::Identity(), {2, 0, 0}}, Matrix6d::Zero());
  EXPECT_NEAR(ahead(1, 1), (1 + 4) * 2 * one(0, 0), 1e-18);
  uncertainty.start(one);
  EXPECT_LT((uncertainty.at({}, Matrix6d::Zero()) - one).norm(), 1e-18);
}

/// Variance of a sum of a rate's values, so many times each, at the beginning of steps of 1 m: of
/// two that are n steps apart the correlation is exp(-n / kAlike).
double variance_of(const std::vector<double>& times) {
  double sum = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t j = 0; j < times.size(); ++j) {
      const double apart = i > j ? static_cast<double>(i - j) : static_cast<double>(j - i);
      sum += times[i] * times[j] * std::exp(-apart / PoseUncertainty::kAlike);
    }
  }
  return sum;
}

// Three steps of 1 m ahead, without noise: lengths are off by the scales of the three; each step's
// turn moves to the left by 1 m in each step after it, so that the first counts twice and the
// second once. Up likewise, by the turn about the other axis. Back again each counts with the other
// sign, and has become another one meanwhile.
TEST(PoseUncertaintyTest, ErrorsOfTheWayAddUpAsFarAsTheyAreAlike) {
  constexpr double kScale = PoseUncertainty::kScale;
  constexpr double kTurn = PoseUncertainty::kTurn;
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  const auto drive = [&](double way) {
    const Pose step{Eigen::Quaterniond::Identity(), {way, 0, 0}};
    uncertainty.keyframe(step, Matrix6d::Zero(), Eigen::MatrixXd::Zero(6, 0));
  };
  for (int i = 0; i < 3; ++i) drive(1);
  const Matrix6d there = uncertainty.at({}, Matrix6d::Zero());
  const double along = variance_of({1, 1, 1});
  EXPECT_NEAR(there(0, 0), kScale * kScale * along, 1e-15);
  for (const int axis : {3, 4, 5}) {
    EXPECT_NEAR(there(axis, axis), kTurn * kTurn * along, 1e-15) << axis;
  }
  for (const int axis : {1, 2}) {
    EXPECT_NEAR(there(axis, axis), kTurn * kTurn * variance_of({2, 1, 0}), 1e-15) << axis;
  }
  // Of 2 a + b and a + b + c: half of what the square of their sum has beyond their own squares.
  const double both = variance_of({3, 2, 1}) - variance_of({2, 1, 0}) - along;
  EXPECT_NEAR(there(1, 5), kTurn * kTurn * both / 2, 1e-15);
  // A frame 2 m further on, with another rate, and 2 m times the turns until then to the left.
  const Pose further{Eigen::Quaterniond::Identity(), {2, 0, 0}};
  const Matrix6d frame = uncertainty.at(further, Matrix6d::Zero());
  EXPECT_NEAR(frame(0, 0), kScale * kScale * variance_of({1, 1, 1, 2}), 1e-15);
  EXPECT_NEAR(frame(1, 1), kTurn * kTurn * variance_of({4, 3, 2}), 1e-15);
  EXPECT_NEAR(frame(5, 5), kTurn * kTurn * variance_of({1, 1, 1, 2}), 1e-15);
  for (int i = 0; i < 3; ++i) drive(-1);
  const Matrix6d back = uncertainty.at({}, Matrix6d::Zero());
  const double returned = variance_of({1, 1, 1, -1, -1, -1});
  EXPECT_NEAR(back(0, 0), kScale * kScale * returned, 1e-15);
  EXPECT_NEAR(back(5, 5), kTurn * kTurn * returned, 1e-15);
  uncertainty.start(Matrix6d::Zero());
  EXPECT_EQ(uncertainty.at({}, Matrix6d::Zero()).norm(), 0);
}

// A metre ahead without noise has the variance kScale^2; measured with four times that it has
// 1 / (1 + 1/4) = 0.8 of it.
TEST(PoseUncertaintyTest, AMeasurementTellsOfErrorsOfTheWay) {
  constexpr double kScale = PoseUncertainty::kScale;
  const Pose step{Eigen::Quaterniond::Identity(), {1, 0, 0}};
  PoseUncertainty uncertainty;
  uncertainty.start(1e-12 * Matrix6d::Identity());
  uncertainty.keyframe(step, Matrix6d::Zero(), Eigen::MatrixXd::Zero(6, 0));
  Matrix6d measured = Matrix6d::Identity();
  measured(0, 0) = 4 * kScale * kScale;
  uncertainty.measure(measured);
  EXPECT_NEAR(uncertainty.at({}, Matrix6d::Zero())(0, 0), 0.8 * kScale * kScale, 1e-11);
}

// The way of that metre, measured exactly, tells its scale s; of the next metre's, exp(-1 / kAlike)
// times s but for what is left of its variance.
TEST(PoseUncertaintyTest, AMeasurementTellsOfErrorsOfTheWayToCome) {
  constexpr double kScale = PoseUncertainty::kScale;
  const Pose step{Eigen::Quaterniond::Identity(), {1, 0, 0}};
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  uncertainty.keyframe(step, Matrix6d::Zero(), Eigen::MatrixXd::Zero(6, 0));
  uncertainty.measure(1e-18 * Matrix6d::Identity());
  const double left = 1 - std::exp(-2 / PoseUncertainty::kAlike);
  EXPECT_NEAR(uncertainty.at(step, Matrix6d::Zero())(0, 0), kScale * kScale * left, 1e-15);
}

// Of two errors one makes each step 1 mm longer, one turns it by 2 mrad to the left: after three
// steps of 1 m the first adds up to 3 mm ahead; the second turns by 6 mrad and moves to the left by
// 2 mm for the step after the first turn and 4 mm for the one after the second.
TEST(PoseUncertaintyTest, ErrorsOfTheCalibrationAddUpInALine) {
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  Eigen::MatrixXd drift = Eigen::MatrixXd::Zero(6, 2);
  drift(0, 0) = 0.001;
  drift(5, 1) = 0.002;
  const Pose ahead{Eigen::Quaterniond::Identity(), {1, 0, 0}};
  for (int i = 0; i < 3; ++i) uncertainty.keyframe(ahead, 1e9 * Matrix6d::Identity(), drift);
  const Matrix6d none = uncertainty.of_calibration({}, Eigen::MatrixXd::Zero(2, 2));
  EXPECT_EQ(none.norm(), 0);
  const Matrix6d added = uncertainty.of_calibration({}, Eigen::MatrixXd::Identity(2, 2));
  EXPECT_NEAR(added(0, 0), 0.003 * 0.003, 1e-15);
  EXPECT_NEAR(added(5, 5), 0.006 * 0.006, 1e-15);
  EXPECT_NEAR(added(1, 1), 0.006 * 0.006, 1e-15);
  EXPECT_NEAR(added(1, 5), 0.006 * 0.006, 1e-15);
  // A frame 2 m further on is moved by 2 m times 6 mrad more.
  const Pose further{Eigen::Quaterniond::Identity(), {2, 0, 0}};
  EXPECT_NEAR(uncertainty.of_calibration(further, Eigen::MatrixXd::Identity(2, 2))(1, 1),
              0.018 * 0.018, 1e-15);
  // A tag that fixes the pose takes all of it away.
  uncertainty.start(Matrix6d::Zero());
  EXPECT_EQ(uncertainty.of_calibration({}, Eigen::MatrixXd::Identity(2, 2)).norm(), 0);
}

// Of two errors one has moved the keyframe by 3 mm; the other moves this frame alone by 4 mm. A
// correlation of a half: 9 + 16 + 2 * 0.5 * 3 * 4.
TEST(PoseUncertaintyTest, AFrameIsMovedBesides) {
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  Eigen::MatrixXd drift = Eigen::MatrixXd::Zero(6, 2), frame = Eigen::MatrixXd::Zero(6, 2);
  drift(0, 0) = 0.003;
  frame(0, 1) = 0.004;
  const Eigen::Matrix2d error{{1, 0.5}, {0.5, 1}};
  // Before any keyframe it is all there is.
  EXPECT_NEAR(uncertainty.of_calibration({}, error, frame)(0, 0), 16e-6, 1e-15);
  uncertainty.keyframe({}, 1e9 * Matrix6d::Identity(), drift);
  EXPECT_NEAR(uncertainty.of_calibration({}, error, frame)(0, 0), 37e-6, 1e-15);
  EXPECT_NEAR(uncertainty.of_calibration({}, error)(0, 0), 9e-6, 1e-15);
}

// Three keyframes before it is known that each is moved by 1 mm, and one after.
TEST(PoseUncertaintyTest, ADriftThatIsFoundLateWasThereBefore) {
  PoseUncertainty uncertainty;
  uncertainty.start(Matrix6d::Zero());
  Eigen::MatrixXd drift = Eigen::MatrixXd::Zero(6, 1);
  for (int i = 0; i < 3; ++i) uncertainty.keyframe({}, 1e9 * Matrix6d::Identity(), drift);
  drift(0, 0) = 0.001;
  uncertainty.keyframe({}, 1e9 * Matrix6d::Identity(), drift);
  EXPECT_NEAR(uncertainty.of_calibration({}, Eigen::MatrixXd::Identity(1, 1))(0, 0), 0.004 * 0.004,
              1e-15);
}

// Two independent measurements of 3 and 4 mm: 1 / (1/9 + 1/16) = 5.76 = 2.4^2.
TEST(PoseUncertaintyTest, AMeasurementMakesItSurer) {
  PoseUncertainty uncertainty;
  uncertainty.start(9e-6 * Matrix6d::Identity());
  uncertainty.measure(16e-6 * Matrix6d::Identity());
  const Matrix6d now = uncertainty.at({}, Matrix6d::Zero());
  EXPECT_LT((now - 5.76e-6 * Matrix6d::Identity()).norm(), 1e-15);
}

TEST(PoseUncertaintyTest, AGapMayComeBeforeAnyKeyframe) {
  PoseUncertainty uncertainty;
  uncertainty.cross_gap(sample_step(), Matrix6d::Identity());
  EXPECT_EQ(uncertainty.at({}, Matrix6d::Zero()), Matrix6d::Identity());
  EXPECT_EQ(uncertainty.of_calibration({}, Eigen::MatrixXd::Zero(2, 2)).norm(), 0);
}

}  // namespace
}  // namespace vinebench::slam
