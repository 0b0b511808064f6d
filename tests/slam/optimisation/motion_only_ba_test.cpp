// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/motion_only_ba.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

constexpr double kMinShare = 0.4;

Pose truth() {
  return {exp_so3({0.01, -0.02, 0.1}), {0.15, 0.05, 0.01}};
}

/// 7 cm and 4 degrees from the truth.
Pose prediction() {
  return truth() * Pose{exp_so3({0.03, 0.02, -0.06}), {0.05, -0.04, 0.03}};
}

int count(const Associations& associations, std::size_t view) {
  int tied = 0;
  for (const int id : associations[view]) tied += id >= 0;
  return tied;
}

/// Associates the chosen features of a view with wrong landmarks.
template <class Choice>
void spoil(std::vector<int>& view, const Choice& choose) {
  const std::vector<int> before = view;
  for (std::size_t f = 0; f < view.size(); ++f) {
    if (before[f] >= 0 && choose(f)) view[f] = before[(f + 37) % before.size()];
  }
}

TEST(MotionOnlyBaTest, IsExactWithoutNoise) {
  const SyntheticAisle aisle(0, 1, 2000);
  const AisleMap known(aisle, {Pose{}});
  const auto frame = aisle.frame(1, truth());
  Associations associations = known.associate(*frame);
  const Associations before = associations;
  const MotionEstimate estimate =
      estimate_motion(known.map, *frame, prediction(), known.rig, kMinShare, associations);
  // Pixels are floats: 1.5e-5 px in 263 at about a metre, a hundred landmarks and more.
  EXPECT_LT(distance(estimate.T_map_body, truth()), 1e-7);
  EXPECT_LT(angle(estimate.T_map_body, truth()), 1e-7);
  EXPECT_EQ(associations, before);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_GT(count(before, v), 100);
    EXPECT_EQ(estimate.matches_per_view[v], count(before, v));
    EXPECT_EQ(estimate.inliers_per_view[v], count(before, v));
  }
  EXPECT_EQ(estimate.inliers, count(before, 0) + count(before, 1));
}

TEST(MotionOnlyBaTest, BearsFortyPercentOutliers) {
  const SyntheticAisle aisle(0.5, 1, 2000);
  const AisleMap known(aisle, {Pose{}});
  const auto frame = aisle.frame(1, truth());
  const Associations right = known.associate(*frame);
  Associations associations = right;
  for (std::vector<int>& view : associations) spoil(view, [](std::size_t f) { return f % 5 < 2; });
  const MotionEstimate estimate =
      estimate_motion(known.map, *frame, prediction(), known.rig, kMinShare, associations);
  // Half a pixel is 2 mm at a metre; over some 200 inliers 0.15 mm, and four times that.
  EXPECT_LT(distance(estimate.T_map_body, truth()), 6e-4);
  EXPECT_LT(angle(estimate.T_map_body, truth()), 6e-4);
  int kept_right = 0;
  int kept_wrong = 0;
  int were_right = 0;
  int inliers = 0;
  for (std::size_t v = 0; v < 2; ++v) {
    for (std::size_t f = 0; f < right[v].size(); ++f) {
      were_right += right[v][f] >= 0 && f % 5 >= 2;
      if (associations[v][f] < 0) continue;
      ++inliers;
      (associations[v][f] == right[v][f] ? kept_right : kept_wrong) += 1;
    }
  }
  EXPECT_EQ(estimate.inliers, inliers);
  // The noise here is half of what the chi-square limit assumes: no correct one is removed.
  EXPECT_GT(kept_right, were_right * 97 / 100);
  // A wrong one may fit by chance.
  EXPECT_LT(kept_wrong, were_right * 2 / 100);
}

TEST(MotionOnlyBaTest, AViewThatIsAllWrongIsNotBelieved) {
  const SyntheticAisle aisle(0.5, 1, 2000);
  const AisleMap known(aisle, {Pose{}});
  const auto frame = aisle.frame(1, truth());
  for (const std::size_t wrong : {std::size_t{0}, std::size_t{1}}) {
    Associations associations = known.associate(*frame);
    const int in_good_view = count(associations, 1 - wrong);
    spoil(associations[wrong], [](std::size_t) { return true; });
    const MotionEstimate estimate =
        estimate_motion(known.map, *frame, prediction(), known.rig, kMinShare, associations);
    EXPECT_LT(distance(estimate.T_map_body, truth()), 1e-3) << wrong;
    EXPECT_EQ(count(associations, wrong), 0) << wrong;
    EXPECT_EQ(estimate.inliers_per_view[wrong], 0) << wrong;
    EXPECT_GT(estimate.inliers, in_good_view * 97 / 100) << wrong;
  }
}

TEST(MotionOnlyBaTest, TooFewMatchesLeaveThePrediction) {
  const SyntheticAisle aisle(0, 1, 2000);
  const AisleMap known(aisle, {Pose{}});
  const auto frame = aisle.frame(1, truth());
  const Associations all = known.associate(*frame);
  Associations few = no_associations(*frame);
  int tied = 0;
  for (std::size_t f = 0; f < all[0].size() && tied < 5; ++f) {
    few[0][f] = all[0][f];
    tied += all[0][f] >= 0;
  }
  ASSERT_EQ(tied, 5);
  const MotionEstimate estimate =
      estimate_motion(known.map, *frame, prediction(), known.rig, kMinShare, few);
  EXPECT_EQ(estimate.inliers, 0);
  EXPECT_EQ(distance(estimate.T_map_body, prediction()), 0);
  EXPECT_EQ(count(few, 0), 0);
}

}  // namespace
}  // namespace vinebench::slam
