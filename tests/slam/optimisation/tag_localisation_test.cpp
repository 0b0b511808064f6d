// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/tag_localisation.h"

#include <gtest/gtest.h>

#include "core/geometry/step_covariance.h"
#include "slam/optimisation/bundle_adjustment.h"
#include "slam/tags/tag_pose.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::angle;
using test::distance;
using test::SyntheticAisle;

constexpr int kSide = 4;  // index of the rover's tag camera
constexpr double kSize = 0.161;

class TagFixTest : public testing::Test {
 protected:
  /// A tag at T_cam_tag, its corners with `noise` px.
  TagSighting sighting(int id, const Pose& T_cam_tag, double noise = 0,
                       RandomSequence* random = nullptr) const {
    const PinholeCamera& lens = rig_.rig.cameras[kSide].model;
    TagSighting seen;
    seen.camera = kSide;
    seen.family = "tag36h11";
    seen.id = id;
    seen.corner_sigma = noise;
    for (std::size_t c = 0; c < 4; ++c) {
      seen.corners[c] = lens.project(T_cam_tag * tag_corners(kSize)[c]);
      if (random != nullptr) {
        seen.corners[c].x() += random->normal(0, noise);
        seen.corners[c].y() += random->normal(0, noise);
      }
    }
    seen.T_cam_tag = estimate_tag_pose(seen.corners, lens, kSize, std::max(noise, 0.05)).T_cam_tag;
    return seen;
  }

  Pose T_body_cam() const { return rig_.rig.cameras[kSide].T_body_cam; }

  PlacedSighting placed(const TagSighting& seen, const Pose& T_cam_tag) const {
    return {body_ * T_body_cam() * T_cam_tag, kSize, &seen};
  }

  SyntheticAisle aisle_{0, 1, 10};
  EstimatorRig rig_{aisle_.rig, OrbConfig{}};
  const Pose body_{exp_so3({0, 0, 0.4}), {2, 1, 0}};
  const Pose a_{exp_so3({0.3, 0.2, 0.1}), {-0.3, 0.1, 0.8}};
  const Pose b_{exp_so3({-0.2, 0.4, 0}), {0.4, -0.1, 1.0}};
  const Pose c_{exp_so3({0.2, -0.3, 0.2}), {0.1, 0.3, 0.9}};
};

TEST_F(TagFixTest, APosesErrorsAreAsItsCovarianceSays) {
  RandomSequence random(RandomStream(1, "corners"));
  double sum = 0;
  constexpr int kDraws = 400;
  for (int i = 0; i < kDraws; ++i) {
    const TagSighting seen = sighting(0, a_, 0.1, &random);
    const Matrix6d covariance = tag_covariance(seen, kSize, rig_.tag_cameras, 0);
    sum += pose_chi_squared(T_body_cam() * a_, T_body_tag(seen, rig_.tag_cameras), covariance) /
           kDraws;
  }
  // Six degrees of freedom: variance 12 a draw, 0.17 of the mean of 400; three times that.
  EXPECT_NEAR(sum, 6, 0.55);
}

TEST_F(TagFixTest, FarAndAslantCountsLess) {
  const auto deviation = [&](const Pose& T_cam_tag) {
    const TagSighting seen = sighting(0, T_cam_tag, 0.1);
    return std::sqrt(
        tag_covariance(seen, kSize, rig_.tag_cameras, 0).topLeftCorner<3, 3>().trace());
  };
  const double near = deviation({exp_so3({0.2, 0.2, 0}), {0, 0, 0.7}});
  const double far = deviation({exp_so3({0.2, 0.2, 0}), {0, 0, 2.8}});
  const double aslant = deviation({exp_so3({0, 1.05, 0}), {0, 0, 0.7}});
  // Range is known by the tag's size in the image: its error grows with the square of the range.
  EXPECT_NEAR(far / near, 16, 3);
  EXPECT_GT(aslant, near);
  // What the corners' own noise adds to the lens's.
  TagSighting noisy = sighting(0, a_, 0.3);
  EXPECT_DOUBLE_EQ(corner_sigma(noisy, 0.4), 0.5);
}

TEST_F(TagFixTest, CovariancesAreCarriedAsPosesMove) {
  // One axis at a time: the difference of two poses moved by a known step has that step's size.
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d step = Vector6d::Zero();
    step[axis] = 1e-5;
    const Pose moved = body_ * step_of(step) * a_;
    Matrix6d covariance = 1e-14 * Matrix6d::Identity();
    covariance(axis, axis) = 1e-10;
    // One standard deviation, in any direction of the resulting pose.
    EXPECT_NEAR(pose_chi_squared(body_ * a_, moved, carry_covariance(covariance, a_)), 1, 1e-3)
        << axis;
  }
}

TEST_F(TagFixTest, TwoTagsKnowTogetherWhatEachKnows) {
  RandomSequence random(RandomStream(2, "corners"));
  const auto information = [&](const TagSighting& seen) -> Matrix6d {
    const Matrix6d by_tag = tag_covariance(seen, kSize, rig_.tag_cameras, 0);
    return carry_covariance(by_tag, T_body_tag(seen, rig_.tag_cameras).inverse()).inverse();
  };
  double sum = 0;
  constexpr int kDraws = 400;
  for (int i = 0; i < kDraws; ++i) {
    const TagSighting a = sighting(0, a_, 0.1, &random);
    const TagSighting b = sighting(1, b_, 0.1, &random);
    const auto by_both = locate_by_tags({placed(a, a_), placed(b, b_)}, rig_.tag_cameras, 0);
    ASSERT_TRUE(by_both);
    const Matrix6d covariance = (information(a) + information(b)).inverse();
    sum += pose_chi_squared(body_, *by_both, covariance) / kDraws;
  }
  EXPECT_NEAR(sum, 6, 0.55);  // as above
}

TEST_F(TagFixTest, OfTwoThatContradictEachOtherNoneIsBelieved) {
  const TagSighting a = sighting(0, a_);
  const TagSighting b = sighting(1, b_);
  const TagSighting c = sighting(2, c_);
  PlacedSighting moved = placed(b, b_);
  moved.T_ref_tag.translation.y() += 0.3;
  EXPECT_FALSE(locate_by_tags({placed(a, a_), moved}, rig_.tag_cameras, 0.1));
  EXPECT_FALSE(locate_by_tags({}, rig_.tag_cameras, 0.1));
  const auto by_most = locate_by_tags({moved, placed(a, a_), placed(c, c_)}, rig_.tag_cameras, 0.1);
  ASSERT_TRUE(by_most);
  EXPECT_LT(distance(*by_most, body_), 1e-6);
  EXPECT_LT(angle(*by_most, body_), 1e-6);
}

}  // namespace
}  // namespace vinebench::slam
