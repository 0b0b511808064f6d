// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/child_drive.h"

#include <gmock/gmock.h>

#include "core/util/error.h"
#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

Sample sample() {
  Sample sample = *test::FakeSource(7).next();
  sample.frame.images[1].release();  // a dropped image
  sample.frame.image_stamps = {7, 8, 9};
  sample.frame.imu = {{5, {1, 2, 3}, {4, 5, 6}}};
  sample.frame.wheels = {{6, {1, 2, 3, 4}, {5, 6, 7, 8}}};
  sample.truth.path = {{4, sample.truth.T_world_body}};
  return sample;
}

TEST(ChildDriveTest, ASampleSurvivesItsMessage) {
  const Sample sent = sample();
  const Sample received = unpack_sample(pack_sample(sent));
  EXPECT_EQ(received.frame.index, sent.frame.index);
  EXPECT_EQ(received.frame.stamp, sent.frame.stamp);
  ASSERT_EQ(received.frame.images.size(), 3u);
  EXPECT_TRUE(received.frame.images[1].empty());
  EXPECT_EQ(received.frame.images[2].at<cv::Vec3b>(5, 7), sent.frame.images[2].at<cv::Vec3b>(5, 7));
  EXPECT_EQ(received.frame.image_stamps, sent.frame.image_stamps);
  EXPECT_EQ(received.frame.imu.at(0).specific_force, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(received.frame.wheels.at(0).velocity[3], 8);
  EXPECT_EQ(received.truth.T_world_body.translation, sent.truth.T_world_body.translation);
  EXPECT_EQ(received.truth.path.at(0).stamp, 4);
  EXPECT_EQ(pack_sample(received), pack_sample(sent));
}

TEST(ChildDriveTest, GivesTheFramesOfTheOtherProcess) {
  ChildDrive drive([] { return std::make_unique<test::FakeSource>(1, 3); }, test::fake_rig());
  test::FakeSource here(1, 3);
  for (int i = 0; i < 3; ++i) {
    Sample expected = *here.next();
    EXPECT_EQ(pack_sample(drive.next().value()), pack_sample(expected)) << i;
  }
  EXPECT_FALSE(drive.next().has_value());
}

TEST(ChildDriveTest, ItsErrorIsThrownHere) {
  ChildDrive drive([]() -> std::unique_ptr<FrameSource> { fail("no such world"); },
                   test::fake_rig());
  EXPECT_THAT(test::error_of([&] { drive.next(); }), testing::HasSubstr("no such world"));
}

// It would go on for long.
TEST(ChildDriveTest, EndsWithItsOwner) {
  ChildDrive drive([] { return std::make_unique<test::FakeSource>(1, 1'000'000'000); },
                   test::fake_rig());
  EXPECT_TRUE(drive.next().has_value());
}

}  // namespace
}  // namespace vinebench::harness
