// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/inertial_average.h"

#include <gtest/gtest.h>

namespace vinebench::sim {
namespace {

ImuSample felt(double turn, double force) {
  return {0, {0, 0, turn}, {force, 0, 0}};
}

TEST(InertialAverageTest, AReadingIsTheMeanSinceTheOneBefore) {
  InertialAverage average;
  average.add(felt(1, 4));
  average.add(felt(2, -1));
  const ImuSample first = average.take(5, felt(9, 9));
  EXPECT_EQ(first.stamp, 5);
  EXPECT_EQ(first.angular_velocity.z(), 1.5);  // of 1 and 2
  EXPECT_EQ(first.specific_force.x(), 1.5);    // of 4 and -1
  average.add(felt(7, 7));
  EXPECT_EQ(average.take(6, felt(9, 9)).angular_velocity.z(), 7);
}

TEST(InertialAverageTest, WithoutAStepItIsTheLatestValue) {
  InertialAverage average;
  const ImuSample reading = average.take(3, felt(0.5, 2));
  EXPECT_EQ(reading.stamp, 3);
  EXPECT_EQ(reading.angular_velocity.z(), 0.5);
  EXPECT_EQ(reading.specific_force.x(), 2);
}

}  // namespace
}  // namespace vinebench::sim
