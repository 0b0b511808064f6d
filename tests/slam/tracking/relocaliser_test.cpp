// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/relocaliser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "slam/matching/appearance_matcher.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

constexpr int kLandmarks = 1500;
constexpr double kNoise = 0.5;  // px

/// Replaces this share of a frame's descriptors by those of random landmarks: wrong matches.
void mislead(FrameFeatures& frame, const Map& map, int percent) {
  const RandomStream random(9, "mislead");
  std::uint64_t draw = 0;
  for (StereoView& view : frame.views) {
    for (Descriptor& descriptor : view.features.descriptors) {
      if (random.uniform(draw++) * 100 >= percent) continue;
      const double at = random.uniform(draw++) * static_cast<double>(map.landmarks().size());
      descriptor = map.landmark(static_cast<int>(at)).descriptor;
    }
  }
}

/// Every descriptor differs from the landmark's in `bits` random bits, like real ones.
void blur(FrameFeatures& frame, int bits) {
  const RandomStream random(10, "blur");
  std::uint64_t draw = 0;
  for (StereoView& view : frame.views) {
    for (Descriptor& descriptor : view.features.descriptors) {
      for (int b = 0; b < bits; ++b) {
        const auto bit = static_cast<std::size_t>(random.uniform(draw++) * 256);
        descriptor[bit / 64] ^= std::uint64_t{1} << (bit % 64);
      }
    }
  }
}

/// Moves this share of a view's features 7 px of their level aside, each another way: they still
/// are where they are looked for, look like their landmarks, and contradict the pose.
void displace(StereoView& view, int percent) {
  const RandomStream random(11, "displace");
  std::uint64_t draw = 0;
  for (Keypoint& keypoint : view.features.keypoints) {
    const bool is_moved = random.uniform(draw++) * 100 < percent;
    const double direction = 2 * std::numbers::pi * random.uniform(draw++);
    if (!is_moved) continue;
    const double aside = 7 * std::pow(OrbConfig{}.scale, keypoint.level);
    keypoint.x += static_cast<float>(aside * std::cos(direction));
    keypoint.y += static_cast<float>(aside * std::sin(direction));
  }
  view.grid = FeatureGrid(view.features.keypoints, 752, 480);
}

/// By one frame, at the places that it resembles most.
std::optional<Relocation> relocate(const Map& map, const EstimatorRig& rig,
                                   const FrameFeatures& frame, const RelocaliserOptions& options) {
  const std::vector<double> alike = resemblance(map, frame, options.queries, options.max_hamming);
  return relocate_among(map, rig, frame, keyframes_alike(map, alike, options.candidates), options);
}

class RelocaliserTest : public testing::Test {
 protected:
  std::optional<Relocation> find(const FrameFeatures& frame) const {
    return relocate(made_.map, made_.rig, frame, {});
  }

  SyntheticAisle aisle_{kNoise, 1, kLandmarks};
  AisleMap made_{aisle_, test::straight_way()};
  const Pose truth_{exp_so3({0, 0, 0.15}), {1.6, 0.08, 0}};
};

TEST_F(RelocaliserTest, FindsWhereAFrameWasTaken) {
  const auto frame = aisle_.frame(100, truth_);
  const auto found = find(*frame);
  ASSERT_TRUE(found);
  // 0.5 px at 263 px and one metre is 2 mm for one feature, a tenth of it for some hundred.
  EXPECT_LT(distance(found->T_map_body, truth_), 0.002);
  EXPECT_LT(angle(found->T_map_body, truth_), 0.002);
  EXPECT_GT(found->inliers, 100);
}

TEST_F(RelocaliserTest, FindsItAmongWrongMatchesAndChangedLooks) {
  const auto frame = aisle_.frame(100, truth_);
  blur(*frame, 30);
  mislead(*frame, made_.map, 40);
  const auto found = find(*frame);
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->T_map_body, truth_), 0.003);
}

TEST_F(RelocaliserTest, FindsItTurnedAbout) {
  // The back pair sees what the front pair mapped.
  const Pose turned = truth_ * Pose{exp_so3({0, 0, 3.0}), Eigen::Vector3d::Zero()};
  const auto found = find(*aisle_.frame(100, turned));
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->T_map_body, turned), 0.003);
}

TEST_F(RelocaliserTest, OnePairIsEnough) {
  const auto found = find(*aisle_.frame(100, truth_, {1}));
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->T_map_body, truth_), 0.004);
}

TEST_F(RelocaliserTest, FindsNothingInAnotherAisle) {
  const SyntheticAisle other(kNoise, 2, kLandmarks);
  EXPECT_FALSE(find(*other.frame(100, truth_)));
}

TEST_F(RelocaliserTest, FindsNothingWhereLooksAgreeButPlacesDoNot) {
  const auto frame = aisle_.frame(100, truth_);
  mislead(*frame, made_.map, 100);
  EXPECT_FALSE(find(*frame));
}

TEST_F(RelocaliserTest, FindsNothingWithoutFeaturesOrWithoutAMap) {
  EXPECT_FALSE(find(*aisle_.frame(100, truth_, {0, 1})));
  EXPECT_FALSE(relocate(Map(1.2), made_.rig, *aisle_.frame(100, truth_), {}));
}

/// Two identical segments of a row: neither may be chosen.
TEST_F(RelocaliserTest, FindsNothingWhereTwoPlacesLookTheSame) {
  Map map(OrbConfig{}.scale);
  for (const double shift : {0.0, 20.0}) {
    std::map<int, int> landmark_of;
    for (const Pose& pose : test::straight_way()) {
      const auto frame = aisle_.frame(static_cast<std::int64_t>(map.keyframes().size()), pose);
      Pose moved = pose;
      moved.translation.x() += shift;
      const int id = map.add_keyframe(frame, moved, no_associations(*frame));
      for (std::size_t v = 0; v < frame->views.size(); ++v) {
        for (std::size_t f = 0; f < frame->views[v].features.size(); ++f) {
          const int point = aisle_.point_of(frame->views[v].features.descriptors[f]);
          const Observation seen{id, static_cast<int>(v), static_cast<int>(f)};
          if (const auto known = landmark_of.find(point); known != landmark_of.end()) {
            map.add_observation(known->second, seen);
          } else {
            const Eigen::Vector3d p = aisle_.point(point) + Eigen::Vector3d(shift, 0, 0);
            landmark_of[point] = map.add_landmark(p, seen);
          }
        }
      }
    }
    for (const auto& [point, landmark] : landmark_of) map.refresh(landmark, made_.rig.T_body_cams);
  }
  EXPECT_FALSE(relocate(map, made_.rig, *aisle_.frame(100, truth_), {}));
}

TEST_F(RelocaliserTest, TwoFramesInARowMustAgree) {
  Relocaliser relocaliser;
  EXPECT_FALSE(relocaliser.find(made_.map, made_.rig, *aisle_.frame(100, truth_)));
  const Pose next = truth_ * Pose{{1, 0, 0, 0}, {0.02, 0, 0}};
  const auto found = relocaliser.find(made_.map, made_.rig, *aisle_.frame(101, next));
  ASSERT_TRUE(found);
  EXPECT_LT(distance(*found, next), 0.002);
}

TEST_F(RelocaliserTest, FramesThatDisagreeAreNotBelieved) {
  Relocaliser relocaliser;
  EXPECT_FALSE(relocaliser.find(made_.map, made_.rig, *aisle_.frame(100, truth_)));
  // 1.1 m within 67 ms.
  EXPECT_FALSE(relocaliser.find(made_.map, made_.rig, *aisle_.frame(101, test::straight_way()[2])));
  EXPECT_TRUE(relocaliser.has_candidate());
  // A blind frame between, without wheels, restarts the confirmation.
  EXPECT_FALSE(relocaliser.find(made_.map, made_.rig, *aisle_.frame(102, truth_, {0, 1})));
  EXPECT_FALSE(relocaliser.has_candidate());
  EXPECT_FALSE(relocaliser.find(made_.map, made_.rig, *aisle_.frame(103, truth_)));
  EXPECT_TRUE(relocaliser.find(made_.map, made_.rig, *aisle_.frame(104, truth_)));
}

/// Over a blind frame, where the wheels say that the body moved by `wheels` from frame to frame and
/// it moved 3 cm: what the third frame finds.
std::optional<Pose> find_over_a_gap(const AisleMap& made, const SyntheticAisle& aisle,
                                    const Pose& from, double wheels) {
  Relocaliser relocaliser;
  std::optional<Pose> found;
  for (int i = 0; i < 3; ++i) {
    const Pose at = from * Pose{{1, 0, 0, 0}, {0.03 * i, 0, 0}};
    const auto frame = i == 1 ? aisle.frame(100 + i, at, {0, 1}) : aisle.frame(100 + i, at);
    frame->wheels = WheelStep{{{1, 0, 0, 0}, {wheels, 0, 0}}, 1.0 / 15};
    found = relocaliser.find(made.map, made.rig, *frame);
  }
  return found;
}

// Two steps of 3 cm; wheels may be off by 5 cm and a tenth of the way, 5.6 cm.
TEST_F(RelocaliserTest, FramesApartAgreeIfTheWheelsSaySo) {
  EXPECT_TRUE(find_over_a_gap(made_, aisle_, truth_, 0.03));
  EXPECT_TRUE(find_over_a_gap(made_, aisle_, truth_, 0.055));
  EXPECT_FALSE(find_over_a_gap(made_, aisle_, truth_, 0.065));
}

/// Of the front pair's features four fifths are displaced.
std::shared_ptr<FrameFeatures> unsure_frame(const SyntheticAisle& aisle, std::int64_t index,
                                            const Pose& at) {
  auto frame = aisle.frame(index, at);
  displace(frame->views[0], 80);
  return frame;
}

TEST_F(RelocaliserTest, WhatMostMatchesOfACameraContradictIsAHintAtMost) {
  const auto frame = unsure_frame(aisle_, 100, truth_);
  EXPECT_FALSE(find(*frame));
  const auto hint = relocate(made_.map, made_.rig, *frame, {.unsure = true});
  ASSERT_TRUE(hint);
  EXPECT_FALSE(hint->is_sure);
  EXPECT_LT(distance(hint->T_map_body, truth_), 0.005);
  EXPECT_TRUE(
      relocate(made_.map, made_.rig, *aisle_.frame(100, truth_), {.unsure = true})->is_sure);
}

TEST_F(RelocaliserTest, WhatNoMatchOfACameraBearsOutIsNoHint) {
  const auto frame = aisle_.frame(100, truth_);
  displace(frame->views[0], 100);
  EXPECT_FALSE(relocate(made_.map, made_.rig, *frame, {.unsure = true}));
}

TEST_F(RelocaliserTest, ThreeHintsAreBelievedWhereTheWheelsAgree) {
  for (const bool wheels : {true, false}) {
    Relocaliser relocaliser;
    std::vector<bool> believed;
    for (int i = 0; i < 4; ++i) {
      const Pose at = truth_ * Pose{{1, 0, 0, 0}, {0.03 * i, 0, 0}};
      const auto frame = unsure_frame(aisle_, 100 + i, at);
      if (wheels) frame->wheels = WheelStep{{{1, 0, 0, 0}, {0.03, 0, 0}}, 1.0 / 15};
      believed.push_back(relocaliser.find(made_.map, made_.rig, *frame).has_value());
    }
    EXPECT_EQ(believed, (std::vector<bool>{false, false, wheels, wheels}));
  }
}

// The second frame finds a place 1.1 m away: three frames and two more must agree, which are the
// first, the third and those up to the sixth.
TEST_F(RelocaliserTest, HintsThatContradictNeedMore) {
  Relocaliser relocaliser;
  std::vector<bool> believed;
  for (int i = 0; i < 6; ++i) {
    const Pose at = i == 1 ? truth_ * Pose{{1, 0, 0, 0}, {-1.1, 0, 0}} : truth_;
    const auto frame = unsure_frame(aisle_, 100 + i, at);
    frame->wheels = WheelStep{{}, 1.0 / 15};
    believed.push_back(relocaliser.find(made_.map, made_.rig, *frame).has_value());
  }
  EXPECT_EQ(believed, (std::vector<bool>{false, false, false, false, false, true}));
}

TEST_F(RelocaliserTest, TheSameFrameGivesTheSameBits) {
  const auto frame = aisle_.frame(100, truth_);
  const auto a = find(*frame);
  const auto b = find(*frame);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->T_map_body.translation, b->T_map_body.translation);
  EXPECT_EQ(a->T_map_body.rotation.coeffs(), b->T_map_body.rotation.coeffs());
}

}  // namespace
}  // namespace vinebench::slam
