// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/calibration_average.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::slam {
namespace {

/// All numbers of so many pairs within 1 of the rig file.
CalibrationBelief within_one(std::size_t pairs) {
  CalibrationBelief belief = CalibrationBelief::nothing(pairs);
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
  const CalibrationAverage found = average(within_one(1), within_one(1));
  EXPECT_NEAR(found.file_is_right, 0.5, 1e-12);
  EXPECT_EQ(found.mean.norm(), 0);
  // Of the 255 sets of eight causes, 128 have any one of them.
  EXPECT_NEAR(found.covariance(6, 6), 0.5 * 128 / 255, 1e-12);
}

// Numbers that are known apart are added up without a matrix: to what one with a correlation of
// 1e-300, which rounds to nothing, gives.
TEST(CalibrationAverageTest, NumbersThatAreKnownApartTakeNoMatrix) {
  CalibrationBelief prior = within_one(2);
  prior.information.diagonal().setLinSpaced(0.3, 7.0);
  CalibrationBelief matrix = prior;
  matrix.information(0, 1) = matrix.information(1, 0) = 1e-300;
  const CalibrationAverage apart = average(prior, prior), together = average(matrix, matrix);
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
  const CalibrationAverage found = average(with(prior, 6, 0.5, 1 / std::sqrt(99.0)), prior);
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
// e = 1/sqrt(1 + 100^2). Of fourteen causes eight are of one number, two of two and four of six,
// so that the 16383 sets that share a half have (1 + e)^8 (1 + e^2)^2 (1 + e^6)^4 - 1 of its
// evidence.
TEST(CalibrationAverageTest, AFileThatIsBorneOutIsBelieved) {
  const CalibrationBelief prior = within_one(2);
  CalibrationBelief now = prior;
  for (Eigen::Index i = 0; i < now.information.rows(); ++i) now = with(now, i, 0, 0.01);
  const double e = 1 / std::sqrt(10001.0);
  const double sets =
      std::pow(1 + e, 8) * std::pow(1 + e * e, 2) * std::pow(1 + std::pow(e, 6), 4) - 1;
  EXPECT_NEAR(1 / average(now, prior).file_is_right - 1, sets / 16383, 1e-9);
}

// Numbers of all pairs are wrong together, or there were 2^19 sets of causes.
TEST(CalibrationAverageTest, ManyPairsAreWrongTogether) {
  const CalibrationBelief prior = within_one(3);
  const CalibrationAverage found = average(with(prior, 6, 0.5, 0.01), prior);
  EXPECT_NEAR(found.mean[6], 0.5, 0.001);
  EXPECT_GT(found.covariance(24, 24), 0.99);  // that of the next pair is as unknown as before
}

}  // namespace
}  // namespace vinebench::slam
