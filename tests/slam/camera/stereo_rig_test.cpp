// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/stereo_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"

namespace vinebench::slam {
namespace {

Rig rover() {
  return load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml");
}

TEST(StereoRigTest, WithoutNamesAllOfTheRigIsUsed) {
  const StereoRig rig = make_stereo_rig(rover(), {});
  ASSERT_EQ(rig.pairs.size(), 2u);
  EXPECT_EQ(rig.pairs[0].name, "front");
  EXPECT_EQ(rig.pairs[1].name, "back");
  EXPECT_EQ(rig.pairs[1].left_camera, 2);
  EXPECT_EQ(rig.pairs[1].right_camera, 3);
  EXPECT_NEAR(rig.pairs[1].baseline, 0.12, 1e-14);
  EXPECT_EQ(rig.tag_cameras, std::vector<int>{4});
  EXPECT_EQ(rig.cameras.size(), 5u);
  const Pose identity = rig.pairs[0].T_body_cam * rig.pairs[0].T_cam_body;
  EXPECT_LT((identity.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-14);
}

TEST(StereoRigTest, NamesSelectPairsAndTagCameras) {
  const StereoRig front = make_stereo_rig(rover(), {"front"});
  ASSERT_EQ(front.pairs.size(), 1u);
  EXPECT_EQ(front.pairs[0].name, "front");
  EXPECT_TRUE(front.tag_cameras.empty());
  EXPECT_EQ(front.cameras.size(), 5u);  // indices stay those of the rig
  const StereoRig back = make_stereo_rig(rover(), {"side", "back"});
  ASSERT_EQ(back.pairs.size(), 1u);
  EXPECT_EQ(back.pairs[0].name, "back");
  EXPECT_EQ(back.tag_cameras, std::vector<int>{4});
}

TEST(StereoRigTest, UnknownNamesAndNoPairAreErrors) {
  EXPECT_THAT(
      [] {
        make_stereo_rig(rover(), {"front", "top"});
      },
      testing::ThrowsMessage<Error>(
          testing::AllOf(testing::HasSubstr("csl-rover"), testing::HasSubstr("'top'"))));
  // The name of a camera that is neither a pair nor for tags selects nothing.
  EXPECT_THAT([] { make_stereo_rig(rover(), {"front_left"}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("'front_left'")));
  EXPECT_THAT([] { make_stereo_rig(rover(), {"side"}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("at least one stereo pair")));
}

bool is_rectified_first(const Rig& rig, std::size_t pair) {
  return make_stereo_rig(rig, {}).pairs[pair].rectification != nullptr;
}

TEST(StereoRigTest, RectifiedPairsAreUsedAsTheyAre) {
  const StereoRig rig = make_stereo_rig(rover(), {});
  for (const RectifiedPair& pair : rig.pairs) {
    const RigCamera& left = rig.cameras[static_cast<std::size_t>(pair.left_camera)];
    EXPECT_EQ(pair.rectification, nullptr);
    EXPECT_EQ(pair.lens.fx, left.model.fx);
    EXPECT_EQ(pair.T_body_cam.rotation.coeffs(), left.T_body_cam.rotation.coeffs());
  }
}

TEST(StereoRigTest, OtherPairsAreRectifiedFirst) {
  Rig rig = rover();
  rig.cameras[1].T_body_cam.rotation = rig.cameras[1].T_body_cam.rotation * exp_so3({0, 1e-3, 0});
  EXPECT_TRUE(is_rectified_first(rig, 0));
  EXPECT_FALSE(is_rectified_first(rig, 1));

  rig = rover();
  rig.cameras[3].T_body_cam.translation.z() += 1e-4;  // 0.2 px at 1 m distance
  EXPECT_TRUE(is_rectified_first(rig, 1));

  rig = rover();
  rig.cameras[0].model.distortion[0] = -0.01;
  EXPECT_TRUE(is_rectified_first(rig, 0));

  rig = rover();
  rig.cameras[2].model.fx += 0.1;
  EXPECT_TRUE(is_rectified_first(rig, 1));
}

TEST(StereoRigTest, CamerasTheWrongWayRoundAreAnErrorWherePairIsUsed) {
  Rig rig = rover();
  std::swap(rig.stereo_pairs[0].left, rig.stereo_pairs[0].right);
  EXPECT_THAT([&] { make_stereo_rig(rig, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("stereo pair 'front'")));
  EXPECT_EQ(make_stereo_rig(rig, {"back"}).pairs.size(), 1u);  // the other one is not used
}

}  // namespace
}  // namespace vinebench::slam
