// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/pose_sampling.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

class PoseSamplingTest : public testing::Test {
 protected:
  /// Gives this share of the associations to other landmarks.
  Associations misled(const FrameFeatures& frame, double share) const {
    Associations associations = made_.associate(frame);
    RandomSequence random(RandomStream(3, "misled"));
    const auto count = static_cast<int>(made_.map.landmarks().size());
    for (std::vector<int>& view : associations) {
      for (int& landmark : view) {
        if (landmark < 0 || random.uniform() >= share) continue;
        landmark = (landmark + 1 + random.below(count - 1)) % count;
      }
    }
    return associations;
  }
  std::optional<Pose> sampled(const FrameFeatures& frame, Associations& associations,
                              const PoseSampling& sampling = {}, std::uint64_t seed = 1) const {
    return sample_pose(made_.map, frame, made_.rig, sampling, seed, associations);
  }
  static int tied(const Associations& associations) {
    int count = 0;
    for (const std::vector<int>& view : associations) {
      for (const int landmark : view) count += landmark >= 0;
    }
    return count;
  }

  SyntheticAisle aisle_{0, 1, 1500};
  AisleMap made_{aisle_, {Pose{}, {Eigen::Quaterniond::Identity(), {0.3, 0, 0}}}};
  const Pose truth_{exp_so3({0.05, -0.02, 0.3}), {0.2, 0.1, 0.02}};
};

TEST_F(PoseSamplingTest, FindsThePoseAmongWrongMatches) {
  const auto frame = aisle_.frame(7, truth_);
  const Associations right = made_.associate(*frame);
  Associations associations = misled(*frame, 0.5);
  const auto pose = sampled(*frame, associations);
  ASSERT_TRUE(pose);
  // Pixels are floats, good to 3e-5 px of some 100 px between three matches.
  EXPECT_LT(distance(*pose, truth_), 1e-3);
  EXPECT_LT(angle(*pose, truth_), 1e-3);
  int kept = 0, wrong = 0;
  for (std::size_t v = 0; v < right.size(); ++v) {
    for (std::size_t f = 0; f < right[v].size(); ++f) {
      if (associations[v][f] < 0) continue;
      (associations[v][f] == right[v][f] ? kept : wrong) += 1;
    }
  }
  EXPECT_GT(kept, 0.45 * tied(right));
  // By chance a landmark lies within 4 px of its wrong feature, up to 14 px on the coarsest level:
  // 0.2 % of the image.
  EXPECT_LE(wrong, 0.02 * tied(right));
}

TEST_F(PoseSamplingTest, ThePairThatLooksBackIsEnough) {
  const auto frame = aisle_.frame(7, truth_, {0});
  Associations associations = misled(*frame, 0.3);
  const auto pose = sampled(*frame, associations);
  ASSERT_TRUE(pose);
  EXPECT_LT(distance(*pose, truth_), 1e-3);
}

TEST_F(PoseSamplingTest, WhereTooFewAgreeThereIsNone) {
  const auto frame = aisle_.frame(7, truth_);
  Associations wrong = misled(*frame, 1);
  const Associations before = wrong;
  EXPECT_FALSE(sampled(*frame, wrong));
  EXPECT_EQ(wrong, before);
  Associations right = made_.associate(*frame);
  PoseSampling strict;
  strict.min_inliers = tied(right) + 1;
  EXPECT_FALSE(sampled(*frame, right, strict));
  strict.min_inliers = tied(right);
  EXPECT_TRUE(sampled(*frame, right, strict));
  Associations none = no_associations(*frame);
  EXPECT_FALSE(sampled(*frame, none));
}

TEST_F(PoseSamplingTest, DrawsDependOnFrameAndSeedAlone) {
  const auto frame = aisle_.frame(7, truth_);
  const auto run = [&](std::uint64_t seed) {
    Associations associations = misled(*frame, 0.5);
    return sampled(*frame, associations, {}, seed)->translation;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

}  // namespace
}  // namespace vinebench::slam
