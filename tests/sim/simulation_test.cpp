// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/util/error.h"
#include "sim/config_files.h"
#include "sim/render/gl/gl_renderer.h"
#include "tests/support/shared_plants.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

const std::filesystem::path kModels =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";

constexpr const char* kSmallRig = R"(
name: small
rate_hz: 15
cameras:
  - {name: left, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, 0.06, 0.5]}
  - {name: right, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, -0.06, 0.5]}
  - {name: side, width: 160, height: 96, fx: 80, fy: 80, position: [0, -0.15, 0.5], rpy_deg: [0, 0, -90]}
stereo_pairs:
  - {name: front, left: left, right: right}
tag_cameras: [side]
)";

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         (a.empty() || cv::countNonZero(cv::Mat(a != b).reshape(1)) == 0);
}

class SimulationTest : public testing::Test {
 protected:
  /// Ten frames of a start beside a short row.
  SimulationConfig config() const {
    SimulationConfig config;
    config.world.rows = {{{0, 1.5}, {2, 1.5}}};
    config.rover = load_rover(kModels / "rover.yaml");
    config.rover.rig = folder_.write("rig.yaml", kSmallRig);
    config.route.waypoints.resize(2);
    config.route.waypoints[1].position = {1, 0};
    config.route.acceleration = 2;
    config.duration = 0.6;
    return config;
  }
  std::vector<Sample> run(const SimulationConfig& config, int threads = 1) const {
    WorkerPool pool(threads);
    const auto source = make_simulation(config, 1, test::shared_plants(), pool);
    std::vector<Sample> samples;
    while (auto sample = source->next()) samples.push_back(std::move(*sample));
    return samples;
  }
  static void expect_same_images(const std::vector<Sample>& a, const std::vector<Sample>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t camera = 0; camera < 3; ++camera) {
        EXPECT_TRUE(same(a[i].frame.images[camera], b[i].frame.images[camera])) << i << camera;
      }
    }
  }
  static void expect_same_readings(const std::vector<Sample>& a, const std::vector<Sample>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].frame.imu.size(), b[i].frame.imu.size());
      ASSERT_EQ(a[i].frame.wheels.size(), b[i].frame.wheels.size());
      for (std::size_t k = 0; k < a[i].frame.imu.size(); ++k) {
        EXPECT_EQ(a[i].frame.imu[k].stamp, b[i].frame.imu[k].stamp);
        EXPECT_EQ(a[i].frame.imu[k].specific_force, b[i].frame.imu[k].specific_force);
      }
      for (std::size_t k = 0; k < a[i].frame.wheels.size(); ++k) {
        EXPECT_EQ(a[i].frame.wheels[k].angle, b[i].frame.wheels[k].angle);
      }
    }
  }

  test::TestFolder folder_;
};

TEST_F(SimulationTest, CratesAndPersonsCountWithoutAnyCartonOrTagCamera) {
  SimulationConfig with = config();
  std::string rig = kSmallRig;
  rig.replace(rig.find("tag_cameras: [side]"), 19, "tag_cameras: []");
  with.rover.rig = folder_.write("no-tags.yaml", rig);
  with.duration = 0.01;
  // 0.45 m and more before the front pair, to the right and to the left of its middle.
  with.world.occluders = {{.shape = Occluder::Shape::kCrate, .position = {0.9, -0.35}},
                          {.shape = Occluder::Shape::kPerson, .position = {0.9, 0.35}}};
  const std::vector<Sample> samples = run(with);
  ASSERT_EQ(samples.size(), 1u);
  const Occlusion& left = samples[0].truth.occlusion.at(0);
  EXPECT_GT(left.share(OccluderClass::kCrate), 0.01);
  EXPECT_GT(left.share(OccluderClass::kPerson), 0.05);
  EXPECT_EQ(left.share(OccluderClass::kCarton), 0);
}

// A person crosses 1 m/s before the front pair: after 0.6 s it covers what one covers that stands
// there.
TEST_F(SimulationTest, AMovingOccluderCountsWhereItIs) {
  SimulationConfig walking = config();
  walking.route.waypoints.resize(1);
  walking.route.waypoints[0].wait = 1;
  walking.world.occluders.resize(1);
  Occluder& person = walking.world.occluders[0];
  person.shape = Occluder::Shape::kPerson;
  person.path.emplace();
  person.path->waypoints = {{{1.3, -0.7}}, {{1.3, 1}}};
  SimulationConfig standing = walking;
  standing.world.occluders[0].path.reset();
  standing.world.occluders[0].position = {1.3, -0.1};
  standing.world.occluders[0].yaw_deg = 90;
  const auto share = [](const Sample& sample) {
    return sample.truth.occlusion.at(0).share(OccluderClass::kPerson);
  };
  const std::vector<Sample> moved = run(walking), still = run(standing);
  ASSERT_EQ(moved.size(), 10u);
  EXPECT_GT(share(still[9]), 0.05);
  // The rover has settled to a fraction of a millimetre: a few of the pixels on edges differ.
  EXPECT_NEAR(share(moved[9]), share(still[9]), 0.002);
  EXPECT_GT(std::abs(share(moved[0]) - share(moved[9])), 0.01);
}

TEST_F(SimulationTest, SameBytesForOneAndTwoThreadsWithEveryEffectOn) {
  SimulationConfig all = config();
  all.duration = 0.2;
  CameraSensorConfig& camera = all.sensors.camera;
  camera.exposure.automatic = true;
  camera.fixed_pattern = {0.01, 5, 0.001, 1e6};
  camera.gamma = 1.8;
  camera.vignetting.natural = 0.3;
  camera.blur_subframes = 3;
  camera.readout_time = 0.02;
  camera.readout_bands = 4;
  camera.bayer = BayerPattern::kRggb;
  camera.dirt.resize(1);
  camera.leaves.resize(1);
  all.sensors.timing = {0.002, 0.001, {{"right", 0.001}}};
  all.sensors.drops.camera_rate = 0.3;
  all.sensors.calibration.rotation_deg = 0.2;
  all.sensors.calibration.cameras.resize(1);
  all.sensors.calibration.cameras[0].name = "left";
  all.sensors.calibration.cameras[0].distortion = {-0.1, 0.01, 0, 0};
  const std::vector<Sample> one = run(all, 1);
  const std::vector<Sample> two = run(all, 2);
  ASSERT_EQ(one.size(), 4u);
  expect_same_images(one, two);
  expect_same_readings(one, two);
}

TEST_F(SimulationTest, PerfectSensorsGiveTheTruth) {
  SimulationConfig perfect = config();
  perfect.sensors = perfect_sensors();
  const std::vector<Sample> samples = run(perfect);
  ASSERT_EQ(samples.size(), 10u);
  // The same images, rendered by hand.
  const Rig rig = load_rig(perfect.rover.rig);
  GlRenderer renderer(build_scene(perfect.world, 1, test::shared_plants()), perfect.renderer);
  for (const std::size_t i : {0u, 9u}) {
    const Pose T_world_cam = samples[i].truth.T_world_body * rig.cameras[2].T_body_cam;
    const RenderedImage image = renderer.render(rig.cameras[2].model, T_world_cam, {});
    EXPECT_TRUE(same(samples[i].frame.images[2], image.rgb));
  }
}

TEST_F(SimulationTest, ReadingsReachTheStampAndNoFurther) {
  SimulationConfig late = config();
  late.sensors.timing.stamp_jitter = 0.005;
  late.sensors.camera.blur_subframes = 2;
  late.sensors.camera.exposure.time = 0.01;
  const std::vector<Sample> samples = run(late);
  Stamp last = 0;
  for (const Sample& sample : samples) {
    for (const ImuSample& reading : sample.frame.imu) {
      EXPECT_EQ(reading.stamp, last += 5'000'000);  // 200 Hz, none missing
      EXPECT_LE(reading.stamp, sample.frame.stamp);
    }
    EXPECT_GT(last + 5'000'000, sample.frame.stamp);
  }
}

// The right camera exposes 4 ms after the frame's instant, and every stamp says 1 ms too much.
TEST_F(SimulationTest, TheTruthKnowsHowImagesWereTaken) {
  SimulationConfig taken = config();
  taken.duration = 0.1;
  taken.sensors.camera.exposure.gain_db = 6;
  taken.sensors.camera.readout_time = 0.01;
  taken.sensors.timing.stamp_offset = 0.001;
  taken.sensors.timing.triggers = {{"right", 0.004}};
  const std::vector<Capture> captures = run(taken).back().truth.captures;
  ASSERT_EQ(captures.size(), 3u);
  EXPECT_EQ(captures[0].gain_db, 6);
  EXPECT_EQ(captures[0].readout_time, 0.01);
  EXPECT_DOUBLE_EQ(captures[0].stamp_error, 0.001);
  EXPECT_DOUBLE_EQ(captures[1].stamp_error, -0.003);
}

TEST_F(SimulationTest, LookingAheadChangesNoTruth) {
  const std::vector<Sample> plain = run(config());
  SimulationConfig rolling = config();
  rolling.sensors.camera.readout_time = 0.03;
  rolling.sensors.camera.readout_bands = 2;
  const std::vector<Sample> ahead = run(rolling);
  ASSERT_EQ(plain.size(), ahead.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].truth.T_world_body.matrix(), ahead[i].truth.T_world_body.matrix()) << i;
  }
  expect_same_readings(plain, ahead);
}

TEST_F(SimulationTest, DropsTakeOnlyTheirImages) {
  const std::vector<Sample> whole = run(config());
  SimulationConfig burst = config();
  burst.sensors.drops.bursts = {{{"right"}, 0.2, 0.4}};
  const std::vector<Sample> cut = run(burst);
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const bool dropped = i >= 3 && i < 6;  // 0.2 to 0.4 s at 15 Hz
    EXPECT_EQ(cut[i].frame.images[1].empty(), dropped) << i;
    EXPECT_TRUE(same(cut[i].frame.images[0], whole[i].frame.images[0]));
    if (dropped) continue;
    EXPECT_TRUE(same(cut[i].frame.images[1], whole[i].frame.images[1]));
  }
  expect_same_readings(cut, whole);
}

TEST_F(SimulationTest, InertialNoiseChangesNoImageAndNoWheel) {
  const std::vector<Sample> plain = run(config());
  SimulationConfig shaky = config();
  shaky.sensors.inertial.gyroscope.noise_density = 0.1;
  shaky.sensors.inertial.gyroscope.initial_bias = 0.5;
  const std::vector<Sample> noisy = run(shaky);
  expect_same_images(plain, noisy);
  expect_same_readings(plain, noisy);  // accelerometer and wheels
  EXPECT_NE(plain[1].frame.imu[0].angular_velocity, noisy[1].frame.imu[0].angular_velocity);
}

TEST_F(SimulationTest, TheRigThatIsToldHasNoCalibrationError) {
  SimulationConfig off_true = config();
  off_true.sensors.calibration.rotation_deg = 1;
  WorkerPool pool(1);
  const auto source = make_simulation(off_true, 1, test::shared_plants(), pool);
  const Rig nominal = load_rig(off_true.rover.rig);
  EXPECT_EQ(source->rig().cameras[0].T_body_cam.matrix(), nominal.cameras[0].T_body_cam.matrix());
  EXPECT_FALSE(same(source->next()->frame.images[0], run(config())[0].frame.images[0]));
}

TEST_F(SimulationTest, UnknownCamerasAndNumbersThatAreNoneAreRefused) {
  SimulationConfig wrong = config();
  wrong.sensors.camera.dirt.resize(2);
  wrong.sensors.camera.dirt[1].scope.cameras = {"left", "nobody"};
  wrong.sensors.drops.bursts.push_back({{"nothing"}, 0, std::nullopt});
  const std::string message = test::error_of([&] { run(wrong); });
  EXPECT_THAT(message, HasSubstr("sensors.camera.dirt.1.cameras: rig 'small' has no camera named "
                                 "'nobody'"));
  EXPECT_THAT(message, HasSubstr("sensors.drops.bursts.0.cameras"));
  wrong = config();
  wrong.sensors.camera.exposure.time = 0.06;
  wrong.sensors.camera.readout_time = 0.02;
  EXPECT_THAT(test::error_of([&] { run(wrong); }), HasSubstr("take up to 0.08 s"));
  wrong = config();
  wrong.sensors.camera.noise.full_well = std::nan("");
  wrong.sensors.calibration.focal_px = std::numeric_limits<double>::infinity();
  const std::string numbers = test::error_of([&] { run(wrong); });
  EXPECT_THAT(numbers, HasSubstr("sensors.camera.noise.full_well: expected a number of at least"));
  EXPECT_THAT(numbers, HasSubstr("sensors.calibration.focal_px"));
}

}  // namespace
}  // namespace vinebench::sim
