// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/tag_dissent.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A body that does not turn, so that steps along x are the map's.
class TagDissentTest : public testing::Test {
 protected:
  TagDissentTest() { map_.add_keyframe(std::make_shared<FrameFeatures>(), Pose{}, {}); }

  /// Surveyed `x` m along the row, and seen as far from there as `off`, m.
  static TagWitness witness(int id, double x, double off, double path_length = 0) {
    TagWitness w;
    w.family = "tag36h11";
    w.id = id;
    w.T_world_tag.translation.x() = x;
    w.T_keyframe_tag.translation.x() = x + off;
    w.covariance = 1e-6 * Matrix6d::Identity();  // 1 mm
    w.path_length = path_length;
    return w;
  }

  std::vector<int> agreeing(double drift_per_metre = 0) const {
    const auto drift = [&](double since, double path_length) {
      const double sigma = drift_per_metre * std::abs(path_length - since);
      return Matrix6d(sigma * sigma * Matrix6d::Identity());
    };
    std::vector<int> ids;
    for (const TagWitness& w : dissent_.agreeing(map_, drift)) ids.push_back(w.id);
    return ids;
  }

  Map map_{1.2};
  TagDissent dissent_;
};

TEST_F(TagDissentTest, NobodySaysNothing) {
  EXPECT_THAT(agreeing(), IsEmpty());
}

TEST_F(TagDissentTest, ThoseAgreeThatAreOffInTheSameWay) {
  dissent_.hear(witness(1, 2, 0.5));
  dissent_.hear(witness(2, 5, -0.2));  // alone
  dissent_.hear(witness(3, 8, 0.5));
  EXPECT_THAT(agreeing(), ElementsAre(1, 3));
  dissent_.forget();
  EXPECT_THAT(agreeing(), IsEmpty());
}

TEST_F(TagDissentTest, TheLatestOfATagCounts) {
  dissent_.hear(witness(1, 2, 0.5));
  dissent_.hear(witness(3, 8, 0.5));
  dissent_.hear(witness(1, 2, 0.1));
  EXPECT_THAT(agreeing(), ElementsAre(1));
}

// 99.9 % with six degrees of freedom are 4.74 standard deviations. Both places' millimetre, and the
// first one's milliradian over 6 m to the second, which is along x and moves nothing along it:
// 1.4 mm along x, of which 4.74 are 6.7 mm.
TEST_F(TagDissentTest, WithinWhatSightingsAndSurveysLeaveOpen) {
  dissent_.hear(witness(1, 2, 0));
  dissent_.hear(witness(3, 8, 0.006));
  EXPECT_THAT(agreeing(), ElementsAre(1, 3));
  dissent_.hear(witness(3, 8, 0.0075));
  EXPECT_THAT(agreeing(), ElementsAre(3));
}

TEST_F(TagDissentTest, AndWithinTheDriftBetweenThem) {
  dissent_.hear(witness(1, 2, 0));
  dissent_.hear(witness(3, 8, 0.1, 6));
  EXPECT_THAT(agreeing(0.001), ElementsAre(3));  // 6 mm after 6 m
  EXPECT_THAT(agreeing(0.01), ElementsAre(1, 3));
}

// A corrected map moves what was seen.
TEST_F(TagDissentTest, WhatWasSeenMovesWithItsKeyframe) {
  TagWitness first = witness(1, 2, 0.5);
  dissent_.hear(first);
  map_.add_keyframe(std::make_shared<FrameFeatures>(), Pose{}, {});
  TagWitness second = witness(3, 8, 0.4);
  second.keyframe = 1;
  dissent_.hear(second);
  EXPECT_THAT(agreeing(), ElementsAre(3));
  map_.keyframe(1).T_map_body.translation.x() = 0.1;
  EXPECT_THAT(agreeing(), ElementsAre(1, 3));
}

}  // namespace
}  // namespace vinebench::slam
