// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/place_evidence.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::distance;
using test::SyntheticAisle;

constexpr int kPlaceLandmarks = 1500;
constexpr double kPlaceNoise = 0.5;  // px

class PlaceEvidenceTest : public testing::Test {
 protected:
  PlaceEvidence look(const FrameFeatures& frame, const Pose& T_map_body) const {
    return look_around(made_.map, made_.rig, frame, T_map_body);
  }

  SyntheticAisle aisle_{kPlaceNoise, 1, kPlaceLandmarks};
  AisleMap made_{aisle_, test::straight_way()};
  const Pose truth_{exp_so3({0, 0, 0.15}), {1.6, 0.08, 0}};
};

// A pose by a tag: 2 cm and half a degree off.
TEST_F(PlaceEvidenceTest, AFrameFromThereBearsItOut) {
  const Pose given = truth_ * Pose{exp_so3({0, 0, 0.008}), {0.02, 0, 0}};
  const PlaceEvidence evidence = look(*aisle_.frame(100, truth_), given);
  EXPECT_TRUE(bears_out(evidence));
  // As of a relocalisation: 0.5 px at 263 px and one metre are 2 mm for one feature.
  EXPECT_LT(distance(evidence.T_map_body, truth_), 0.002);
  ASSERT_EQ(evidence.found.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) EXPECT_GE(evidence.expected[v], evidence.found[v]);
}

TEST_F(PlaceEvidenceTest, OneFromAnotherAisleDoesNot) {
  const SyntheticAisle other(kPlaceNoise, 2, kPlaceLandmarks);
  EXPECT_FALSE(bears_out(look(*other.frame(100, truth_), truth_)));
}

TEST_F(PlaceEvidenceTest, NorDoesOneFromElsewhereInIt) {
  Pose elsewhere = truth_;
  elsewhere.translation.x() += 0.5;
  EXPECT_FALSE(bears_out(look(*aisle_.frame(100, elsewhere), truth_)));
}

// What is ahead is as it should be, what is behind is not.
TEST_F(PlaceEvidenceTest, NorOneThatOnlyOnePairBearsOut) {
  const SyntheticAisle other(kPlaceNoise, 2, kPlaceLandmarks);
  const auto frame = aisle_.frame(100, truth_);
  frame->views[1] = other.frame(100, truth_)->views[1];
  EXPECT_FALSE(bears_out(look(*frame, truth_)));
}

TEST_F(PlaceEvidenceTest, NorAnythingWhereTheMapHasNothing) {
  Pose outside = truth_;
  outside.translation.y() += 20;
  const PlaceEvidence evidence = look(*aisle_.frame(100, truth_), outside);
  EXPECT_EQ(evidence.expected, (std::vector<int>{0, 0}));
  EXPECT_FALSE(bears_out(evidence));
}

}  // namespace
}  // namespace vinebench::slam
