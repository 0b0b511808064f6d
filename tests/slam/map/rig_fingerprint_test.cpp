// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/rig_fingerprint.h"

#include <gtest/gtest.h>

#include "slam/map/binary_archive.h"

namespace vinebench::slam {
namespace {

class RigFingerprintTest : public testing::Test {
 protected:
  static RigFingerprint rover() {
    const Rig rig = load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml");
    return rig_fingerprint(EstimatorRig(make_stereo_rig(rig, {}), OrbConfig{}));
  }
  std::string found() const { return difference(print_, rover()); }
  RigFingerprint print_ = rover();
};

TEST_F(RigFingerprintTest, HasAllThatAMapDependsOn) {
  ASSERT_EQ(print_.cameras.size(), 5u);
  EXPECT_EQ(print_.cameras[4].name, "side");
  ASSERT_EQ(print_.pairs.size(), 2u);
  EXPECT_EQ(print_.pairs[0].name, "front");
  EXPECT_NEAR(print_.pairs[1].baseline, 0.12, 1e-12);
  EXPECT_EQ(print_.level_scales.size(), static_cast<std::size_t>(OrbConfig{}.levels));
  EXPECT_EQ(found(), "");
}

TEST_F(RigFingerprintTest, RoundingsOfACalibrationAreNoDifference) {
  print_.cameras[0].model.fx *= 1 + 1e-9;
  print_.cameras[1].T_body_cam.translation.x() += 1e-7;
  print_.pairs[0].baseline += 1e-8;
  print_.level_scales[3] *= 1 - 1e-9;
  EXPECT_EQ(found(), "");
}

TEST_F(RigFingerprintTest, OtherCamerasAreSaidSo) {
  print_.cameras[2].name = "rear";
  EXPECT_EQ(found(), "its camera 2 is 'rear', here 'back_left'");
  print_ = rover();
  print_.cameras[0].model.cx += 0.5;
  EXPECT_EQ(found(), "camera 'front_left' has another lens");
  print_ = rover();
  print_.cameras[0].model.distortion[2] = 1e-3;
  EXPECT_EQ(found(), "camera 'front_left' has another lens");
  print_ = rover();
  print_.cameras[4].T_body_cam =
      print_.cameras[4].T_body_cam * Pose{exp_so3({0, 1e-3, 0}), {0, 0, 0}};
  EXPECT_EQ(found(), "camera 'side' sits elsewhere");
  print_ = rover();
  print_.cameras.pop_back();
  EXPECT_EQ(found(), "it has 4 cameras, this one 5");
}

TEST_F(RigFingerprintTest, AFisheyesLensIsKept) {
  print_.cameras[0].model.set_lens(LensModel::kEquidistant, {0.1, 0.2, 0.3, 0.4});
  print_.cameras[1].model.distortion[4] = 0.5;
  for (const std::uint32_t version : {4U, 5U}) {
    BinaryWriter writer(version);
    writer(print_);
    BinaryReader reader(writer.bytes(), "test", version);
    RigFingerprint back;
    reader(back);
    EXPECT_TRUE(reader.at_end());
    // A map of version 4 is of a rig without such lenses.
    const RigFingerprint& expected = version == 5 ? print_ : rover();
    EXPECT_EQ(difference(back, expected) == "", version == 5) << difference(back, expected);
  }
  BinaryWriter writer(4);
  writer(rover());
  BinaryReader reader(writer.bytes(), "test", 4);
  RigFingerprint back;
  reader(back);
  EXPECT_EQ(difference(back, rover()), "");
}

TEST_F(RigFingerprintTest, OtherPairsAreSaidSo) {
  print_.pairs[1].name = "rear";
  EXPECT_EQ(found(), "its pair 1 is 'rear', here 'back'");
  for (const auto& change : std::vector<void (*)(RigFingerprint::Pair&)>{
           [](RigFingerprint::Pair& pair) { pair.baseline += 1e-3; },
           [](RigFingerprint::Pair& pair) { pair.lens.fy += 0.1; },
           [](RigFingerprint::Pair& pair) { pair.left_camera = 4; },
           [](RigFingerprint::Pair& pair) { pair.T_body_cam.translation.z() += 1e-3; }}) {
    print_ = rover();
    change(print_.pairs[0]);
    EXPECT_EQ(found(), "pair 'front' has another calibration");
  }
  print_ = rover();
  print_.pairs.pop_back();
  EXPECT_EQ(found(), "it uses 1 stereo pairs, this one 2");
}

TEST_F(RigFingerprintTest, AnotherPyramidIsSaidSo) {
  print_.level_scales.pop_back();
  EXPECT_EQ(found(), "its features have another scale pyramid");
  print_ = rover();
  print_.level_scales[1] = 1.25;
  EXPECT_EQ(found(), "its features have another scale pyramid");
}

}  // namespace
}  // namespace vinebench::slam
