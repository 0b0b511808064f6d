// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/image_times.h"

#include <gtest/gtest.h>

#include "slam/factors/calibration_belief.h"
#include "tests/support/synthetic_aisle.h"

namespace vinebench::slam {
namespace {

/// A frame with landmarks in three features of the first pair, at 0, a quarter and the whole of the
/// image's height, and in one of the second, in its middle; others have none.
class ImageTimesTest : public testing::Test {
 protected:
  ImageTimesTest() {
    frame_.velocity << 0.4, 0.1, 0, 0, 0.02, 0.6;
    frame_.views.resize(2);
    const double height = rig_.left_cameras[0].lens.height;
    put(0, {0, 0.25 * height, height, 0.75 * height});
    put(1, {0.5 * height, 0});
  }
  void put(std::size_t view, const std::vector<double>& rows) {
    for (const double row : rows) {
      Keypoint point;
      point.y = static_cast<float>(row);
      frame_.views[view].features.keypoints.push_back(point);
    }
  }
  ErrorOfImageTimes error() const { return error_of_image_times(frame_, associations_, rig_); }

  FrameFeatures frame_;
  Associations associations_{{5, 6, 7, -1}, {8, -1}};
  EstimatorRig rig_{test::SyntheticAisle(0, 1, 0).rig, {}};
};

// Three of the four features are in images that are late by a first pair's time: the body is three
// quarters of that time's way behind where it seems to be. Their rows are off by -1/2, -1/4 and 1/2
// of the readout from the middle, together -1/4, a sixteenth for each of the four.
TEST_F(ImageTimesTest, EachImageCountsByItsFeatures) {
  const Eigen::MatrixXd by_calibration = error().by_calibration;
  ASSERT_EQ(by_calibration.cols(), 2 * kPairUnknowns + 1);
  const Eigen::Index second = kPairUnknowns;
  EXPECT_LT((by_calibration.col(PairNumber::kTime) + 0.75 * frame_.velocity).norm(), 1e-15);
  EXPECT_LT((by_calibration.col(second + PairNumber::kTime) + 0.25 * frame_.velocity).norm(),
            1e-15);
  EXPECT_LT((by_calibration.col(PairNumber::kReadout) - 0.0625 * frame_.velocity).norm(), 1e-15);
  EXPECT_LT(by_calibration.col(second + PairNumber::kReadout).norm(), 1e-15);
  // Nothing else moves this frame alone.
  EXPECT_NEAR(by_calibration.squaredNorm(),
              (0.75 * 0.75 + 0.25 * 0.25 + 0.0625 * 0.0625) * frame_.velocity.squaredNorm(), 1e-15);
}

// All images at once: the velocity does not matter. The second pair's 40 ms late: a quarter of it.
TEST_F(ImageTimesTest, TheVelocityCountsForAsLongAsImagesAreLate) {
  EXPECT_EQ(error().by_velocity.norm(), 0);
  frame_.views[1].late = 0.04;
  const Vector6d sigma = 0.01 * error_of_velocity();
  EXPECT_LT((error().by_velocity.diagonal() - sigma.cwiseAbs2()).norm(), 1e-18);
}

TEST_F(ImageTimesTest, WithoutLandmarksThereIsNoError) {
  associations_ = {{-1, -1, -1, -1}, {-1, -1}};
  EXPECT_EQ(error().by_calibration.norm(), 0);
  EXPECT_EQ(error().by_velocity.norm(), 0);
}

}  // namespace
}  // namespace vinebench::slam
