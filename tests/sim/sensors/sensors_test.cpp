// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/sensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kEverything = R"(camera:
  exposure: {automatic: true, target: 120, max_time: 0.01}
  noise: {full_well: 10000, read_noise: 3}
  fixed_pattern: {response: 0.01, hot_pixels: 0.0001}
  gamma: 1
  vignetting: {natural: 0.4, polynomial: [-0.1, 0, 0.02]}
  blur_subframes: 6
  readout_time: 0.016
  bayer: grbg
  white_balance: {red: 1.2, blue: 0.9}
  response: {matrix: [1.4, -0.4, 0, 0, 1, 0, 0, 0, 1], saturation: 1.1, contrast: 0.3}
  jpeg: {quality: 85}
  dirt:
    - {cameras: front_left, from: 2, until: 3, count: 7}
    - {opacity: 0.3}
  leaves:
    - {cameras: [front_left, side], position: [0.1, 0.9], angle_deg: -30}
timing: {stamp_jitter: 0.001, triggers: [{camera: side, delay: -0.002}]}
drops: {camera_rate: 0.01, bursts: [{from: 5, until: 6}]}
calibration: {rotation_deg: 0.1, cameras: [{name: side, focal_px: [2, 3]}]}
inertial: {gyroscope: {noise_density: 0.001, range: 4}}
wheels: {counts_per_turn: 1024}
)";

class SensorsTest : public testing::Test {
 protected:
  SensorsConfig read(const std::string& text) const {
    return YamlDocument::load(folder_.write("sensors.yaml", text)).read<SensorsConfig>();
  }
  std::string error(const std::string& text) const {
    return test::error_of([&] { read(text); });
  }

  test::TestFolder folder_;
};

TEST_F(SensorsTest, ReadsEveryKindOfKey) {
  const SensorsConfig config = read(kEverything);
  EXPECT_TRUE(config.camera.exposure.automatic);
  EXPECT_EQ(config.camera.bayer, BayerPattern::kGrbg);
  EXPECT_EQ(config.camera.white_balance.blue, 0.9);
  EXPECT_EQ(config.camera.response.matrix[1], -0.4);
  EXPECT_EQ(config.camera.jpeg.quality, 85);
  ASSERT_EQ(config.camera.dirt.size(), 2u);
  EXPECT_TRUE(config.camera.dirt[0].scope.applies_to("front_left"));
  EXPECT_FALSE(config.camera.dirt[0].scope.applies_to("side"));
  EXPECT_FALSE(config.camera.dirt[0].scope.is_active(from_seconds(1.999)));
  EXPECT_TRUE(config.camera.dirt[0].scope.is_active(from_seconds(2)));
  EXPECT_FALSE(config.camera.dirt[0].scope.is_active(from_seconds(3)));
  EXPECT_TRUE(config.camera.dirt[1].scope.applies_to("side"));
  EXPECT_TRUE(config.camera.dirt[1].scope.is_active(from_seconds(1e5)));
  EXPECT_EQ(config.calibration.cameras[0].focal_px, Eigen::Vector2d(2, 3));
  EXPECT_EQ(config.inertial.gyroscope.range, 4);
}

TEST_F(SensorsTest, WritesWhatItReads) {
  const std::string written = format_yaml(read(kEverything));
  EXPECT_EQ(format_yaml(read(written)), written);
  EXPECT_EQ(format_yaml(read("{}")), format_yaml(SensorsConfig{}));
}

TEST_F(SensorsTest, ErrorsNameLineKeyAndExpectation) {
  EXPECT_THAT(error("camera:\n  noise: {full_well: 0}\n"),
              AllOf(HasSubstr("sensors.yaml:2"), HasSubstr("camera.noise.full_well"),
                    HasSubstr("expected a number of at least 10")));
  EXPECT_THAT(error("camera:\n  gamma: .nan\n"), HasSubstr("camera.gamma"));
  EXPECT_THAT(error("camera:\n  dirt:\n    - {from: 3, until: 2}\n"),
              AllOf(HasSubstr("sensors.yaml:3"), HasSubstr("expected a time after from")));
  EXPECT_THAT(error("camera: {bayer: rgbg}\n"), HasSubstr("rggb, grbg, gbrg, bggr"));
  EXPECT_THAT(error("camera: {exposure: {min_time: 0.01, max_time: 0.001}}\n"),
              HasSubstr("expected at least min_time"));
  EXPECT_THAT(error("camera: {jpeg: {quality: 0}}\n"), HasSubstr("camera.jpeg.quality"));
  EXPECT_THAT(error("camera: {jpeg: {quality: 101}}\n"), HasSubstr("camera.jpeg.quality"));
  EXPECT_THAT(error("camera: {white_balance: {red: 0}}\n"), HasSubstr("white_balance.red"));
  EXPECT_THAT(error("camera: {response: {contrast: 2}}\n"), HasSubstr("response.contrast"));
  EXPECT_THAT(error("camera: {response: {matrix: [1, 0, 0]}}\n"), HasSubstr("response.matrix"));
  EXPECT_THAT(error("camera: {sharpness: 1}\n"), HasSubstr("unknown key"));
  EXPECT_THAT(error("wheels: {counts_per_turn: -1}\n"), HasSubstr("wheels.counts_per_turn"));
  EXPECT_THAT(error("timing: {triggers: [{camera: side, delay: 3}]}\n"),
              HasSubstr("timing.triggers.0.delay"));
}

TEST_F(SensorsTest, PerfectOnesChangeNothing) {
  const SensorsConfig config = perfect_sensors();
  EXPECT_TRUE(PhotonTransfer(config.camera.noise, config.camera.gamma).is_identity());
  EXPECT_EQ(config.inertial.gyroscope.noise_density, 0);
  EXPECT_EQ(config.wheels.counts_per_turn, 0);
}

}  // namespace
}  // namespace vinebench::sim
