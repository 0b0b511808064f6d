// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

Rig pair_and_side() {
  Rig rig;
  rig.rate_hz = 15;
  for (const char* name : {"left", "right", "side"}) rig.cameras.push_back({name, {}, {}});
  rig.stereo_pairs = {{"front", 0, 1}};
  return rig;
}

/// Images of uniform walls of that light with that exposure.
cv::Mat image(double light, const Exposure& exposure, const ExposureConfig& config) {
  const double code = code_of_light(light * exposure.factor(config.reference_time));
  return {48, 64, CV_8UC3, cv::Scalar::all(std::round(code))};
}

ExposureConfig automatic() {
  ExposureConfig config;
  config.automatic = true;
  config.reference_time = 0.002;
  config.time = 0.002;
  return config;
}

/// Brightness, frame by frame, of walls of these lights.
std::vector<double> brightness_over(ExposureControl& control, const ExposureConfig& config,
                                    double light, int frames) {
  std::vector<double> brightness;
  for (int i = 0; i < frames; ++i) {
    const cv::Mat left = image(light, control.of(0), config);
    brightness.push_back(mean_brightness(left));
    control.observe({left, left, image(light, control.of(2), config)});
  }
  return brightness;
}

/// The exposure that is metered on a wall of that light, after one of another light in the other
/// group.
Exposure metered(const ExposureConfig& config, double light) {
  ExposureControl control(config, pair_and_side());
  control.meter([&](std::size_t camera) {
    return image(camera == 2 ? 1e-3 : light, control.of(camera), config);
  });
  return control.of(1);
}

TEST(ExposureTest, MeteredOnTheFirstImage) {
  const ExposureConfig config;
  for (const double light : {0.01, 0.1, 0.9}) {
    // The last is burnt out at first. Code 110 is a light of (110 / 255)^2.2 = 0.157.
    const Exposure exposure = metered(config, light);
    EXPECT_NEAR(light * exposure.factor(config.reference_time), 0.157, 0.01) << light;
  }
}

TEST(ExposureTest, AGivenGainIsBesideTheMeteredOne) {
  ExposureConfig config;
  const Exposure plain = metered(config, 0.1);
  config.gain_db = -6;
  const Exposure darker = metered(config, 0.1);
  EXPECT_EQ(darker.time, plain.time);
  EXPECT_EQ(darker.gain_db, plain.gain_db - 6);
}

TEST(ExposureTest, AFactorIsMeteredOnWhatIsDrawnWithIt) {
  const double factor = metered_factor([](double by) {
    return cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(std::round(code_of_light(0.05 * by))));
  });
  EXPECT_NEAR(0.05 * factor, 0.157, 0.002);  // half a code is 1 % of light
}

TEST(ExposureTest, AGivenTimeIsNotMetered) {
  ExposureConfig config;
  config.time = 0.003;
  config.gain_db = -6;
  const Exposure exposure = metered(config, 1e-5);
  EXPECT_EQ(exposure.time, 0.003);
  EXPECT_EQ(exposure.gain_db, -6);
}

TEST(ExposureTest, FixedStaysFixed) {
  ExposureConfig config;
  config.time = config.reference_time;
  ExposureControl control(config, pair_and_side());
  brightness_over(control, config, 0.01, 5);
  EXPECT_EQ(control.of(0).time, *config.time);
  EXPECT_EQ(control.of(0).gain_db, 0);
  EXPECT_EQ(control.of(0).factor(config.reference_time), 1);
}

TEST(ExposureTest, AutomaticReachesItsTarget) {
  for (const double light : {0.002, 0.05, 0.9}) {
    const ExposureConfig config = automatic();
    ExposureControl control(config, pair_and_side());
    // 2 s are seven time constants: a thousandth of the error is left.
    EXPECT_NEAR(brightness_over(control, config, light, 30).back(), config.target, 1.5) << light;
  }
}

TEST(ExposureTest, TheErrorFallsByAThirdsPowerOfEInATimeConstant) {
  ExposureConfig config = automatic();
  config.time_constant = 0.4;  // six frames
  ExposureControl control(config, pair_and_side());
  const double before = control.of(0).time;
  brightness_over(control, config, 0.3 * light_of_code(config.target), 6);
  // The exposure has to grow by 1 / 0.3; 1 - 1 / e of its logarithm in six frames. Codes are whole:
  // 64 +- 0.5 is 1.7 % of light.
  EXPECT_NEAR(std::log(control.of(0).time / before), -(1 - std::exp(-1)) * std::log(0.3), 0.02);
}

TEST(ExposureTest, TimeComesFirstThenGain) {
  const ExposureConfig config = automatic();
  ExposureControl control(config, pair_and_side());
  brightness_over(control, config, 0.03, 40);  // requires 5.3 times the light: 10 ms
  EXPECT_LT(control.of(0).time, config.max_time);
  EXPECT_EQ(control.of(0).gain_db, 0);
  brightness_over(control, config, 0.003, 40);  // 53 times: 16 ms and 6.6-fold
  EXPECT_EQ(control.of(0).time, config.max_time);
  EXPECT_NEAR(control.of(0).gain_db, 20 * std::log10(52.5 / 8), 0.5);
}

TEST(ExposureTest, LimitsHold) {
  const ExposureConfig config = automatic();
  ExposureControl control(config, pair_and_side());
  brightness_over(control, config, 1e-7, 300);
  EXPECT_EQ(control.of(0).time, config.max_time);
  EXPECT_EQ(control.of(0).gain_db, config.max_gain_db);
  brightness_over(control, config, 1000, 300);
  EXPECT_EQ(control.of(0).time, config.min_time);
  EXPECT_EQ(control.of(0).gain_db, 0);
}

TEST(ExposureTest, APairSharesAndTheSideCameraDoesNot) {
  const ExposureConfig config = automatic();
  ExposureControl control(config, pair_and_side());
  const cv::Mat dark(8, 8, CV_8UC1, cv::Scalar(20));
  const cv::Mat bright(8, 8, CV_8UC1, cv::Scalar(200));
  control.observe({dark, bright, bright});
  EXPECT_EQ(&control.of(0), &control.of(1));
  EXPECT_EQ(control.of(0).time, *config.time);  // (20 + 200) / 2 is the target
  EXPECT_LT(control.of(2).time, *config.time);
  const double side = control.of(2).time;
  control.observe({cv::Mat(), cv::Mat(), cv::Mat()});  // nothing was delivered
  EXPECT_EQ(control.of(2).time, side);
  control.observe({dark, cv::Mat(), cv::Mat()});
  EXPECT_GT(control.of(1).time, *config.time);
}

}  // namespace
}  // namespace vinebench::sim
