// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/variant_drive.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "harness/explain/child_drive.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

class VariantDriveTest : public test::CourtScenario {
 protected:
  std::vector<Sample> frames(const Variant& variant, const Splice& splice) {
    VariantDrive drive(variant, splice, kFrames - 1, machine(), pool_);
    std::vector<Sample> list;
    while (auto sample = drive.next()) list.push_back(std::move(*sample));
    same_drive_ = drive.is_same_drive();
    return list;
  }

  static Splice splice_after(const Sample& sample) {
    return {sample.frame.index + 1, sample.frame.stamp, sample.truth.path.back()};
  }

  WorkerPool pool_{1};
  bool same_drive_ = false;
};

// All bytes of the samples but for the path, which then is that since the start.
TEST_F(VariantDriveTest, WithoutAFactorTheSplicedDriveIsTheDrive) {
  const std::vector<Sample> whole = frames({scenario()}, {});
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(kFrames));
  std::vector<Sample> rest = frames({scenario()}, splice_after(whole[2]));
  EXPECT_TRUE(same_drive_);
  ASSERT_EQ(rest.size(), 3u);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    rest[i].truth.path = whole[i + 3].truth.path;
    EXPECT_EQ(pack_sample(rest[i]), pack_sample(whole[i + 3])) << i;
  }
  EXPECT_FALSE(whole[3].frame.wheels.empty());
  EXPECT_FALSE(whole[3].frame.imu.empty());
}

// An eighth of the signal is 255 * 8^(-1 / 2.2) = 99 at white, and the drive is the same.
TEST_F(VariantDriveTest, AFactorChangesTheImagesAndNotTheDrive) {
  ScenarioConfig dark = scenario();
  dark.simulation.sensors.camera.exposure.gain_db = -18;
  const std::vector<Sample> whole = frames({scenario()}, {});
  const std::vector<Sample> rest = frames({dark}, splice_after(whole[2]));
  EXPECT_TRUE(same_drive_);
  EXPECT_LT(cv::mean(rest[0].frame.images[0])[0], 0.6 * cv::mean(whole[3].frame.images[0])[0]);
  EXPECT_EQ(rest[2].truth.T_world_body.translation, whole[5].truth.T_world_body.translation);
}

TEST_F(VariantDriveTest, NoticesThatTheDriveIsAnotherOne) {
  const std::vector<Sample> whole = frames({scenario()}, {});
  ScenarioConfig slower = scenario();
  slower.simulation.route.speed = 0.1;
  frames({slower}, splice_after(whole[3]));
  EXPECT_FALSE(same_drive_);
}

// Rolling wheels go on from the last reading before the splice. Encoders read 4096 counts a turn,
// 1.5e-3 rad each; in a tenth of a second on even ground the wheels slip by far less than 0.05 rad.
TEST_F(VariantDriveTest, WheelsThatRollGoOnFromTheSplice) {
  const std::vector<Sample> whole = frames({scenario()}, {});
  const std::vector<Sample> rest =
      frames({.scenario = scenario(), .without_slip = true}, splice_after(whole[2]));
  ASSERT_EQ(rest[0].frame.wheels.size(), whole[3].frame.wheels.size());
  const WheelSample& rolled = rest[1].frame.wheels.back();
  const WheelSample& read = whole[4].frame.wheels.back();
  EXPECT_EQ(rolled.stamp, read.stamp);
  EXPECT_NE(rolled.angle[0], read.angle[0]);
  EXPECT_NEAR(rolled.angle[0], read.angle[0], 0.05);
}

TEST_F(VariantDriveTest, TheEstimatorIsToldOfIdealLenses) {
  folder_.write("rig.yaml", R"(name: bent
rate_hz: 15
cameras:
  - {name: left, width: 160, height: 96, fx: 80, fy: 80, distortion: [0.1, 0, 0, 0]}
)");
  Variant variant{scenario()};
  EXPECT_EQ(told_rig(variant).cameras[0].model.distortion[0], 0.1);
  variant.ideal_lenses = true;
  EXPECT_EQ(told_rig(variant).cameras[0].model.distortion[0], 0);
}

}  // namespace
}  // namespace vinebench::harness
