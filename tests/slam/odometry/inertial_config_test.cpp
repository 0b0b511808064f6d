// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/inertial_config.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

TEST(InertialConfigTest, TheRigSaysWhatIsNotSet) {
  const ImuNoise of_rig{{1.7e-4, 2e-5}, {2e-3, 3e-3}};
  InertialConfig config;
  config.gyroscope.noise_density = 1e-3;
  config.accelerometer.bias = 0.1;
  const auto noise = inertial_noise(config, of_rig);
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->gyroscope.noise_density, 1e-3);
  EXPECT_EQ(noise->gyroscope.bias_random_walk, 2e-5);
  EXPECT_EQ(noise->gyroscope.bias, InertialNoise{}.gyroscope.bias);  // no data sheet has it
  EXPECT_EQ(noise->accelerometer.noise_density, 2e-3);
  EXPECT_EQ(noise->accelerometer.bias_random_walk, 3e-3);
  EXPECT_EQ(noise->accelerometer.bias, 0.1);
}

TEST(InertialConfigTest, AUsualUnitWhereTheRigSaysNothing) {
  const auto noise = inertial_noise(InertialConfig{}, std::nullopt);
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->gyroscope.noise_density, InertialNoise{}.gyroscope.noise_density);
  EXPECT_EQ(noise->accelerometer.bias_random_walk, InertialNoise{}.accelerometer.bias_random_walk);
}

TEST(InertialConfigTest, NoneTakesPartUnlessItIsAskedTo) {
  EXPECT_FALSE(inertial_noise(std::nullopt, ImuNoise{{1, 1}, {1, 1}}));
}

}  // namespace
}  // namespace vinebench::slam
