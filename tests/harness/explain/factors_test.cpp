// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/factors.h"

#include <gmock/gmock.h>

#include "core/util/error.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

class FactorsTest : public test::CourtScenario {
 protected:
  FactorsTest() {
    calm_.simulation.sensors = sim::perfect_sensors();
    calm_.simulation.world.vines.meshes = {folder_ / "vine.obj"};  // own meshes are not templates
  }

  static std::vector<std::string> names(const ScenarioConfig& scenario) {
    std::vector<std::string> list;
    for (const Factor& factor : factors_of(scenario)) list.push_back(factor.name);
    return list;
  }

  static Variant without(const ScenarioConfig& scenario, const std::string& name) {
    for (const Factor& factor : factors_of(scenario)) {
      if (factor.name != name) continue;
      Variant variant{scenario};
      factor.remove(variant);
      return variant;
    }
    fail("no factor {}", name);
  }

  ScenarioConfig calm_ = scenario();
};

TEST_F(FactorsTest, ACalmDriveHasNone) {
  EXPECT_THAT(names(calm_), ElementsAre());
}

TEST_F(FactorsTest, EachEffectIsAFactorThatGoesWithIt) {
  ScenarioConfig hard = calm_;
  sim::WorldConfig& world = hard.simulation.world;
  sim::CameraSensorConfig& camera = hard.simulation.sensors.camera;
  world.wind.speed = 8;
  world.sky.visibility = 50;
  camera.noise.enabled = true;
  camera.blur_subframes = 4;
  camera.exposure.gain_db = -12;
  camera.readout_time = 0.02;
  camera.vignetting.natural = 1;
  camera.dirt.resize(1);
  camera.leaves.resize(1);
  camera.bayer = sim::BayerPattern::kRggb;
  camera.white_balance.red = 1.2;
  camera.response.contrast = 0.5;
  camera.jpeg.quality = 40;
  hard.simulation.sensors.timing.triggers = {{"right", 0.01}};
  hard.simulation.sensors.timing.stamp_jitter = 0.001;
  hard.simulation.sensors.timing.stamp_offset = 0.03;
  hard.simulation.sensors.calibration.rotation_deg = 0.1;
  EXPECT_THAT(names(hard),
              ElementsAre("haze", "wind", "noise", "blur", "exposure", "rolling-shutter",
                          "vignetting", "dirt", "leaf", "bayer", "white-balance", "response",
                          "jpeg", "triggers", "stamp-jitter", "stamp-offset", "calibration"));
  for (const std::string& name : names(hard)) {
    const ScenarioConfig rest = without(hard, name).scenario;
    EXPECT_THAT(names(rest), Not(Contains(name)));
    EXPECT_EQ(names(rest).size(), 16u) << name;  // the others stay
  }
}

TEST_F(FactorsTest, OccludersGoClassByClassAndThoseThatMoveByThemselves) {
  std::vector<sim::Occluder>& occluders = calm_.simulation.world.occluders;
  occluders.resize(3);
  occluders[1].shape = sim::Occluder::Shape::kPerson;
  occluders[2].shape = sim::Occluder::Shape::kPerson;
  occluders[2].path.emplace();
  EXPECT_THAT(names(calm_), ElementsAre("occluder-carton", "occluder-person", "moving-person"));
  const Variant variant = without(calm_, "occluder-person");
  const auto& rest = variant.scenario.simulation.world.occluders;
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(class_of(rest[0]), OccluderClass::kCarton);
  EXPECT_TRUE(rest[1].path.has_value());
}

TEST_F(FactorsTest, ALowSunIsRaisedFromTheStartOn) {
  sim::WorldConfig& world = calm_.simulation.world;
  world.sun.elevation_deg = 40;
  EXPECT_THAT(names(calm_), ElementsAre());
  world.sun.elevation_deg = 10;
  ASSERT_THAT(names(calm_), ElementsAre("sun"));
  EXPECT_TRUE(factors_of(calm_)[0].from_start);
  // Late in the evening at 45 degrees north: an azimuth in the west.
  world.sun.at.emplace().time = "17:00";
  const sim::WorldConfig raised = without(calm_, "sun").scenario.simulation.world;
  EXPECT_FALSE(raised.sun.at.has_value());
  EXPECT_EQ(raised.sun.elevation_deg, 50);
  EXPECT_NEAR(raised.sun.azimuth_deg, -90, 20);
  EXPECT_EQ(raised.sky.glare, 0);
}

TEST_F(FactorsTest, ARightExposureKeepsItsBlur) {
  sim::ExposureConfig& exposure = calm_.simulation.sensors.camera.exposure;
  exposure.time = 0.008;
  const Variant variant = without(calm_, "exposure");
  const sim::ExposureConfig& right = variant.scenario.simulation.sensors.camera.exposure;
  EXPECT_EQ(right.time, 0.008);
  // As much as the metered time at the reference of the defaults.
  EXPECT_NEAR(*right.time / right.reference_time,
              sim::kNominalTime / sim::ExposureConfig().reference_time, 1e-12);
}

TEST_F(FactorsTest, AnExposureIsRightFromTheRenderersOwnToThatOfAVineyard) {
  sim::ExposureConfig& exposure = calm_.simulation.sensors.camera.exposure;
  const double vineyard = sim::kNominalTime / sim::ExposureConfig().reference_time;
  for (const double factor : {1.0, 2.0, vineyard}) {
    exposure.time = factor * exposure.reference_time;
    EXPECT_THAT(names(calm_), ElementsAre()) << factor;
  }
  for (const double factor : {0.9, 1.1 * vineyard}) {
    exposure.time = factor * exposure.reference_time;
    EXPECT_THAT(names(calm_), ElementsAre("exposure")) << factor;
  }
}

TEST_F(FactorsTest, TagsThatStandWhereTheySayAndOnce) {
  std::vector<sim::WorldConfig::Tag>& tags = calm_.simulation.world.tags;
  tags.assign(3, {});
  tags[0].registered = false;
  tags[2].id = 1;
  tags[2].survey_error.offset.x() = 0.1;
  calm_.simulation.world.survey.position = 0.02;
  EXPECT_THAT(names(calm_), ElementsAre("tag-survey", "tag-copies"));
  const auto& single = without(calm_, "tag-copies").scenario.simulation.world.tags;
  ASSERT_EQ(single.size(), 2u);
  EXPECT_TRUE(single[0].registered);  // the one that the estimator is told of
  EXPECT_EQ(single[1].id, 1);
  const auto straight = without(calm_, "tag-survey");
  EXPECT_EQ(straight.scenario.simulation.world.tags[2].survey_error.offset.x(), 0);
  EXPECT_EQ(straight.scenario.simulation.world.survey.position, 0);
}

TEST_F(FactorsTest, FewTemplatesRepeat) {
  sim::VinesConfig& vines = calm_.simulation.world.vines;
  vines.meshes.clear();
  EXPECT_THAT(names(calm_), ElementsAre());
  vines.templates = 1;
  EXPECT_THAT(names(calm_), ElementsAre("repeated-plants"));
}

TEST_F(FactorsTest, SlipIsAFactorWhereTheWheelsAreNeeded) {
  calm_.simulation.sensors.drops.bursts.resize(1);
  ASSERT_THAT(names(calm_), ElementsAre("drops", "slip"));
  EXPECT_TRUE(without(calm_, "slip").without_slip);
  calm_.simulation.sensors.drops = {};
  calm_.simulation.world.terrain.slope_percent = 5;
  EXPECT_THAT(names(calm_), ElementsAre("ground", "slip"));
}

// The true lenses are the nominal ones plus their error: k1 = 0.1 - 0.1.
TEST_F(FactorsTest, LensesWithoutDistortionForCamerasAndEstimator) {
  folder_.write("rig.yaml", R"(name: bent
rate_hz: 15
cameras:
  - {name: left, width: 160, height: 96, fx: 80, fy: 80, distortion: [0.1, 0, 0, 0]}
)");
  calm_.simulation.sensors.calibration.focal_px = 1;
  ASSERT_THAT(names(calm_), ElementsAre("calibration", "distortion"));
  const Variant variant = without(calm_, "distortion");
  EXPECT_TRUE(variant.ideal_lenses);
  sim::CalibrationErrorConfig error = variant.scenario.simulation.sensors.calibration;
  EXPECT_EQ(error.focal_px, 1);
  error.focal_px = 0;
  const Rig rig = sim::true_rig(load_rig(folder_ / "rig.yaml"), error, 1);
  EXPECT_EQ(rig.cameras[0].model.distortion[0], 0);
  Variant both = variant;
  factors_of(calm_)[0].remove(both);
  EXPECT_EQ(both.scenario.simulation.sensors.calibration.cameras.size(), 1u);
}

// 9000 of 1e7 electrons are 9e-4 of white; at mid grey (code 127, light 0.22) a code is 3.7e-3 of
// white, so that the noise is 0.24 codes and changes every 25th.
TEST_F(FactorsTest, APlaceboIsAnotherNoise) {
  const Variant weak = with_other_noise({calm_}, 3);
  EXPECT_TRUE(weak.scenario.simulation.sensors.camera.noise.enabled);
  EXPECT_EQ(weak.scenario.simulation.sensors.camera.noise.read_noise, 9000);
  EXPECT_EQ(weak.scenario.simulation.sensors.camera.noise.pattern, 3);
  calm_.simulation.sensors.camera.noise.enabled = true;
  const Variant usual = with_other_noise({calm_}, 3);
  EXPECT_EQ(usual.scenario.simulation.sensors.camera.noise.read_noise, 2.5);
}

}  // namespace
}  // namespace vinebench::harness
