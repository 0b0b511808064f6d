// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench::slam {
namespace {

class SlamConfigTest : public testing::Test {
 protected:
  SlamConfig read(const std::string& text) const {
    return YamlDocument::load(folder_.write("slam.yaml", text)).read<SlamConfig>();
  }
  test::TestFolder folder_;
};

TEST_F(SlamConfigTest, ThePapersSettingsAreDefaultsThatOtherKeysReplace) {
  const SlamConfig paper = read("preset: paper\n");
  EXPECT_EQ(paper.loss, ResidualLoss::kHuber);
  EXPECT_EQ(paper.stereo.search, StereoSearch::kFeatures);
  EXPECT_FALSE(paper.refinement.enabled);
  EXPECT_FALSE(paper.stereo.self_calibration);

  const SlamConfig mixed = read("loss: cauchy\nstereo: {self_calibration: true}\npreset: paper\n");
  EXPECT_EQ(mixed.loss, ResidualLoss::kCauchy);
  EXPECT_TRUE(mixed.stereo.self_calibration);
  EXPECT_EQ(mixed.stereo.search, StereoSearch::kFeatures);
}

TEST_F(SlamConfigTest, APresetOverSettingsThatAreWrittenOutIsAnError) {
  SlamConfig config = read("preset: default\n");
  std::string written = format_yaml(config);
  const std::string preset = "preset: default";
  written.replace(written.find(preset), preset.size(), "preset: paper");
  EXPECT_THAT([&] { read(written); }, testing::ThrowsMessage<Error>(
                                          testing::HasSubstr("preset: expected some of the keys")));
}

TEST_F(SlamConfigTest, WheelsAreFusedBesideAnInertialUnitOnly) {
  EXPECT_FALSE(read("preset: default\n").inertial.has_value());
  const SlamConfig fused = read("inertial: {gyroscope: {bias: 0.01}}\nwheels: {slip: 0.1}\n");
  EXPECT_EQ(fused.inertial->gyroscope.bias, 0.01);
  EXPECT_EQ(fused.wheels->slip, 0.1);
  EXPECT_THAT([&] { read("wheels: {}\n"); }, testing::ThrowsMessage<Error>(testing::HasSubstr(
                                                 "wheels: expected an inertial unit beside them")));
}

TEST_F(SlamConfigTest, WrittenOutAndReadAgainIsTheSame) {
  for (const char* text : {"preset: default\n", "preset: paper\nloss: cauchy\n"}) {
    SlamConfig config = read(text);
    const std::string written = format_yaml(config);
    SlamConfig again = read(written);
    EXPECT_EQ(format_yaml(again), written);
  }
}

}  // namespace
}  // namespace vinebench::slam
