// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/notes_of_recording.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vinebench::harness {
namespace {

/// A camera that is turned about all axes, one that looks straight up, and one that looks down.
Rig turned_rig() {
  Rig rig;
  rig.name = "turned";
  rig.rate_hz = 20;
  PinholeCamera lens{640, 400, 300, 301, 320, 199};
  lens.set_lens(LensModel::kEquidistant, {0.1, 0.02, -0.003, 0.0004});
  const double right_angle = std::numbers::pi / 2;
  rig.cameras = {{"a", lens, Rig::mount({0.1, 0.2, 0.3}, {0.2, -0.4, 2.5})},
                 {"b", lens, Rig::mount({0, -0.1, 0}, {0.3, -right_angle, 0.7})},
                 {"c", lens, Rig::mount({0, 0, 1}, {-0.3, right_angle, 0.7})}};
  rig.stereo_pairs = {{"front", 0, 1}};
  rig.tag_cameras = {2};
  rig.imu = ImuNoise{{1e-3, 1e-5}, {1e-2, 1e-4}};
  return rig;
}

TEST(NotesOfRecordingTest, TheRigsYamlFormMakesTheSameRig) {
  const Rig rig = turned_rig();
  const Rig made = config_of(rig).make();
  EXPECT_EQ(made.name, rig.name);
  EXPECT_EQ(made.rate_hz, rig.rate_hz);
  ASSERT_EQ(made.cameras.size(), rig.cameras.size());
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const RigCamera &a = made.cameras[i], &b = rig.cameras[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.model.lens, b.model.lens);
    EXPECT_EQ(a.model.coefficients(), b.model.coefficients());
    EXPECT_EQ(a.model.project({0.1, 0.2, 1}), b.model.project({0.1, 0.2, 1}));
    // At a pitch of 90 degrees the sine's last bit is worth 1e-8 rad.
    EXPECT_TRUE((a.T_body_cam.inverse() * b.T_body_cam).matrix().isIdentity(1e-7)) << i;
  }
  ASSERT_EQ(made.stereo_pairs.size(), 1u);
  EXPECT_EQ(made.stereo_pairs[0].left, 0);
  EXPECT_EQ(made.stereo_pairs[0].right, 1);
  EXPECT_EQ(made.tag_cameras, rig.tag_cameras);
  EXPECT_EQ(made.imu.value().gyroscope.noise_density, 1e-3);
}

TEST(NotesOfRecordingTest, TheInertialRateIsThatOfMostReadings) {
  Recording recording;
  recording.rig = turned_rig();
  EXPECT_EQ(notes_of(recording).imu_rate_hz, RecordingNotes().imu_rate_hz);
  // Steps of 10, 10, 500 and 10 ms: the median is 10 ms.
  for (const double t : {0.00, 0.01, 0.02, 0.52, 0.53}) {
    ImuSample reading;
    reading.stamp = from_seconds(t);
    recording.imu.push_back(reading);
  }
  EXPECT_DOUBLE_EQ(notes_of(recording).imu_rate_hz, 100);
}

}  // namespace
}  // namespace vinebench::harness
