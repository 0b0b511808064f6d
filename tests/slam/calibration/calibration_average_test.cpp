// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/calibration_average.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::slam {
namespace {

/// All numbers of so many pairs and cameras for tags within 1 of the rig file.
CalibrationBelief within_one(std::size_t pairs, std::size_t tag_cameras = 0) {
  CalibrationBelief belief = CalibrationBelief::nothing(pairs, tag_cameras);
  belief.information.setIdentity();
  return belief;
}

/// A measurement of one number besides.
CalibrationBelief with(CalibrationBelief belief, Eigen::Index number, double value, double sigma) {
  belief.information(number, number) += 1 / (sigma * sigma);
  belief.information_vector[number] += value / (sigma * sigma);
  return belief;
}

TEST(CalibrationAverageTest, BeforeAnythingIsSeenEverySecondFileIsRight) {
  const CalibrationAverage found = average(within_one(1), within_one(1), 1);
  EXPECT_NEAR(found.file_is_right, 0.5, 1e-12);
  EXPECT_EQ(found.mean.norm(), 0);
  // Of the 255 sets of eight causes, 128 have any one of them.
  EXPECT_NEAR(found.covariance(6, 6), 0.5 * 128 / 255, 1e-12);
  // Together they have each of the pair's numbers once.
  EXPECT_NEAR(found.numbers_at_work, kPairUnknowns * 0.5 * 128 / 255, 1e-12);
}

// Numbers that are known apart are added up without a matrix: to what one with a correlation of
// 1e-300, which rounds to nothing, gives.
TEST(CalibrationAverageTest, NumbersThatAreKnownApartTakeNoMatrix) {
  CalibrationBelief prior = within_one(2);
  prior.information.diagonal().setLinSpaced(0.3, 7.0);
  CalibrationBelief matrix = prior;
  matrix.information(0, 1) = matrix.information(1, 0) = 1e-300;
  const CalibrationAverage apart = average(prior, prior, 2), together = average(matrix, matrix, 2);
  EXPECT_EQ(apart.file_is_right, together.file_is_right);
  EXPECT_EQ(apart.mean, together.mean);
  EXPECT_EQ(apart.covariance.diagonal(), together.covariance.diagonal());
}

// The disparity offset is measured as 0.5 with a deviation of 1/sqrt(99): together with the file's
// 1 the information is 100, the mean 0.495. Against none at all, an offset has the evidence E =
// exp(49.5^2 / 100 / 2) / sqrt(100); whether other causes are at work changes nothing. Of the 255
// sets 128 have an offset and 127 do not.
TEST(CalibrationAverageTest, WhatExplainsMoreWeighsMore) {
  const CalibrationBelief prior = within_one(1);
  const CalibrationAverage found = average(with(prior, 6, 0.5, 1 / std::sqrt(99.0)), prior, 1);
  const double evidence = std::exp(0.5 * 49.5 * 49.5 / 100) / 10;
  const double without = 0.5 + 0.5 * 127 / 255;
  const double offset = 0.5 * 128 / 255 * evidence;
  const double share = offset / (offset + without);
  EXPECT_NEAR(found.mean[6], share * 0.495, 1e-12);
  EXPECT_NEAR(found.file_is_right, 0.5 / (offset + without), 1e-12);
  // Squares, less that of the mean.
  const double square = share * (0.01 + 0.495 * 0.495);
  EXPECT_NEAR(found.covariance(6, 6), square - found.mean[6] * found.mean[6], 1e-12);
  EXPECT_NEAR(found.mean.norm(), found.mean[6], 1e-15);
}

// All numbers are measured as right, to a hundredth: each that takes part all the same costs
// e = 1/sqrt(1 + 100^2). Of fifteen causes ten are of one number, one of two and four of six, so
// that the 32767 sets that share a half have (1 + e)^10 (1 + e^2) (1 + e^6)^4 - 1 of its evidence.
TEST(CalibrationAverageTest, AFileThatIsBorneOutIsBelieved) {
  const CalibrationBelief prior = within_one(2);
  CalibrationBelief now = prior;
  for (Eigen::Index i = 0; i < now.information.rows(); ++i) now = with(now, i, 0, 0.01);
  const double e = 1 / std::sqrt(10001.0);
  const double sets = std::pow(1 + e, 10) * (1 + e * e) * std::pow(1 + std::pow(e, 6), 4) - 1;
  EXPECT_NEAR(1 / average(now, prior, 2).file_is_right - 1, sets / 32767, 1e-9);
}

// A camera for tags is found 1 behind each of two pairs, to a hundredth. That it alone is wrong has
// the evidence exp(-1 / 2) / sqrt(2e4) = 4.29e-3; one of the pairs besides, which then is not,
// twice exp(-1 / 2) / sqrt(1e8) = 6.1e-5; both pairs and not the camera exp(-1) / 1e4 = 3.7e-5; all
// three, with the camera 2 / 3 behind, exp(-1 / 3) / sqrt(3e8) = 4.1e-5. So it is 0.983 + 2 / 3 *
// 0.009 behind.
TEST(CalibrationAverageTest, AClockThatIsApartFromTwoOthersIsWrong) {
  const CalibrationBelief prior = within_one(2, 1);
  CalibrationBelief now = prior;
  const Eigen::Index tag = 36;
  for (const Eigen::Index time :
       {Eigen::Index{PairNumber::kTime}, kPairUnknowns + PairNumber::kTime}) {
    // (tag - time - 1) / 0.01 squared
    now.information(tag, tag) += 1e4;
    now.information(time, time) += 1e4;
    now.information(tag, time) -= 1e4;
    now.information(time, tag) -= 1e4;
    now.information_vector[tag] += 1e4;
    now.information_vector[time] -= 1e4;
  }
  const CalibrationAverage found = average(now, prior, 2);
  EXPECT_NEAR(found.mean[tag], 0.989, 0.001);
  EXPECT_NEAR(found.mean[tag] - found.mean[PairNumber::kTime], 1, 0.001);
}

// Numbers of all pairs are wrong together, or there were 2^22 sets of causes.
TEST(CalibrationAverageTest, ManyPairsAreWrongTogether) {
  const CalibrationBelief prior = within_one(3);
  const CalibrationAverage found = average(with(prior, 6, 0.5, 0.01), prior, 3);
  EXPECT_NEAR(found.mean[6], 0.5, 0.001);
  EXPECT_GT(found.covariance(24, 24), 0.99);  // that of the next pair is as unknown as before
}

}  // namespace
}  // namespace vinebench::slam
