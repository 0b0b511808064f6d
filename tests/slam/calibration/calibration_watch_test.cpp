// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/calibration_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "core/util/random.h"
#include "slam/features/orb_extractor.h"
#include "slam/tags/tag_sightings.h"
#include "slam/tags/tag_times.h"
#include "tests/support/aisle_map.h"
#include "tests/support/winding_drive.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;
using test::winding;
using test::winding_velocity;

constexpr double kDegree = std::numbers::pi / 180;

/// Drives with cameras that differ from their rig file, and watches.
class CalibrationWatchTest : public testing::Test {
 protected:
  /// The watch knows how large the pixels' noise is.
  CalibrationWatchTest() {
    for (double& scale : made_.rig.noise.level_scales) scale *= 0.3;
  }
  void drive(int keyframes) {
    for (int i = 0; i < keyframes; ++i) {
      const auto id = static_cast<int>(made_.map.keyframes().size());
      aisle_.velocity = speed_ * winding_velocity(id);
      const auto seen = frame(id);
      if (told_late_ > 0) {
        seen->views[1].late = told_late_;
        seen->velocity = thought_velocity(id);
      }
      for (Eigen::Index axis = 3; axis < 6; ++axis) {
        seen->velocity[axis] += velocity_noise_ * random_.normal();
      }
      for (TagSighting& tag : seen->tags) bring(made_.rig.tag_time(tag.camera), tag);
      made_.add(seen, winding(id));
      if (!watch_.due(made_.map)) continue;
      const auto found = watch_.look(made_.map, made_.rig, {});
      if (!found) continue;
      const double before = side_time();
      made_.rig = made_.rig.with_calibration(*found);
      take_tags_later(side(), side_time() - before, made_.rig.tag_cameras, made_.map);
      ++changes_;
    }
  }
  /// With the tag, where there is one and the side camera has it in view.
  std::shared_ptr<FrameFeatures> frame(int id) const {
    const auto seen = aisle_.frame(id, winding(id));
    if (!T_world_tag_) return seen;
    const Pose then = winding(id) * step_of(aisle_.velocity * side_late_);
    const TagSighting tag = aisle_.frame_with_tag(id, then, *T_world_tag_)->tags.front();
    const PinholeCamera& lens = aisle_.rig.cameras[static_cast<std::size_t>(side())].model;
    const auto in_view = [&](const Eigen::Vector2d& corner) { return lens.contains(corner, 5); };
    if (tag.T_cam_tag.translation.z() > 0.1 && std::ranges::all_of(tag.corners, in_view)) {
      seen->tags.push_back(tag);
    }
    return seen;
  }
  /// Too much by 2.5 % of its way, 10 mm/s, and 8 % of its turn, 50 mrad/s, for a dozen, and then
  /// too little.
  static Vector6d thought_velocity(int id) {
    const double sign = id / 12 % 2 == 0 ? 1 : -1;
    Vector6d velocity = winding_velocity(id);
    velocity.head<3>() *= 1 + 0.025 * sign;
    velocity.tail<3>() *= 1 + 0.08 * sign;
    return velocity;
  }
  /// To the frame's stamp, for an image that much after it.
  void bring(double late, TagSighting& tag) const {
    tag.late = late;
    bring_to_stamp(aisle_.velocity, made_.rig.tag_cameras, tag);
  }
  int side() const { return aisle_.rig.tag_cameras.front(); }
  double side_time() const { return made_.rig.tag_time(side()); }
  /// Hangs a tag on the right of the way, half a metre from its beginning.
  void hang_tag() {
    T_world_tag_ = Pose{exp_so3({-0.5 * std::numbers::pi, 0, 0}), {0.5, -0.6, 0.5}};
    MapTag tag;
    tag.family = "tag36h11";
    tag.id = 0;
    tag.size = 0.161;
    tag.T_map_tag = *T_world_tag_;
    made_.map.tags().push_back(tag);
  }
  /// Degrees about the vertical by which a pair is turned, as it is known now.
  double latest_turn(std::size_t pair) const {
    return log_so3(watch_.latest().value().pairs[pair].T_nominal_camera.rotation).y() / kDegree;
  }
  const PairCalibration& front() const { return made_.rig.calibration.pairs[0]; }
  const PairCalibration& back() const { return made_.rig.calibration.pairs[1]; }

  SyntheticAisle aisle_{0.3, 4, 800};
  AisleMap made_{aisle_, {}};
  CalibrationWatch watch_{CalibrationConfig{}, 1, made_.rig};
  double speed_ = 1;
  double velocity_noise_ = 0;  ///< rad/s, of the turn rates that are thought to be
  RandomSequence random_{RandomStream(5, "velocity")};
  double told_late_ = 0;  ///< s, of the back pair's images, by their stamps
  double side_late_ = 0;  ///< s, of the side camera's images, which nobody was told of
  int changes_ = 0;
  std::optional<Pose> T_world_tag_;
};

TEST_F(CalibrationWatchTest, ARightCalibrationStays) {
  drive(60);
  EXPECT_EQ(changes_, 0);
  EXPECT_EQ(back().disparity_offset, 0);
}

// In each of these, what is found is a sum over some thousand pixels of 0.3 px: the bounds are five
// standard deviations of what the watch itself says, which were 0.02 px, 0.02 %, 0.2 mm, 0.01
// degrees, 0.3 ms and 1 ms or less. What is right by itself stays, but for the few per cent of
// probability that is left to its being wrong: within a tenth of these bounds.
TEST_F(CalibrationWatchTest, FindsTheOffsetOfAPairsDisparities) {
  aisle_.calibration[1].disparity_offset = -0.5;
  drive(36);
  EXPECT_GE(changes_, 1);
  EXPECT_NEAR(back().disparity_offset, -0.5, 0.1);
  EXPECT_NEAR(front().disparity_offset, 0, 0.01);
  EXPECT_LT(back().T_nominal_camera.translation.norm(), 1e-4);
}

// Before anything was seen the file is as likely right as wrong, and a wrong one's offset likewise,
// of 65535 sets of causes in 32768: of the prior's variance, 1 px squared.
TEST_F(CalibrationWatchTest, AtFirstTheFileIsRightOrWrong) {
  EXPECT_NEAR(watch_.error(made_.rig)(24, 24), 0.5 * 32768 / 65535, 1e-9);
}

// A right one is borne out: what five dozens leave of the offset's error is less than a hundredth
// of the square of a deviation of 0.05 px.
TEST_F(CalibrationWatchTest, ARightFileIsBorneOut) {
  drive(60);
  EXPECT_LT(watch_.error(made_.rig)(24, 24), 0.01 * 0.05 * 0.05);
}

// How errors move the body is seen from the first keyframes, as a dozen shows it later: an offset
// makes the way longer or shorter, by the same share. A fifth: six keyframes have few landmarks in
// common. When images are taken moves single frames, which do not add up.
TEST_F(CalibrationWatchTest, TheFirstKeyframesShowHowErrorsMoveTheBody) {
  drive(5);
  EXPECT_EQ(watch_.drift().norm(), 0);
  drive(1);
  const double felt = watch_.drift()(0, 24);
  EXPECT_GT(std::abs(felt), 1e-5);
  EXPECT_EQ(watch_.drift().col(PairNumber::kTime).norm(), 0);
  EXPECT_EQ(watch_.drift().col(kPairUnknowns + PairNumber::kReadout).norm(), 0);
  drive(10);
  EXPECT_NE(watch_.drift()(0, 24), felt);
  EXPECT_NEAR(watch_.drift()(0, 24), felt, 0.2 * std::abs(felt));
}

// 30 ms are found in the first six keyframes. The dozen that has the same says it once more: what
// is known counts them once.
TEST_F(CalibrationWatchTest, WhatIsFarOffIsFoundAtTheFirstLook) {
  aisle_.calibration[1].time = 0.03;
  drive(6);
  EXPECT_EQ(changes_, 1);
  EXPECT_NEAR(back().time - front().time, 0.03, 0.005);
  EXPECT_LT(watch_.known().information(24, 24), 1.001);  // of the offset: the prior's, 1 px
}

// What the watch says of its own error: that of the offset is within four standard deviations, and
// less than the prior's 1 px.
TEST_F(CalibrationWatchTest, KnowsItsError) {
  aisle_.calibration[1].disparity_offset = -0.5;
  drive(36);
  ASSERT_GE(changes_, 1);
  const Eigen::MatrixXd error = watch_.error(made_.rig);
  const double sigma = std::sqrt(error(24, 24));
  EXPECT_LT(sigma, 0.1);
  EXPECT_LT(std::abs(back().disparity_offset + 0.5), 4 * sigma);
  // An offset makes what is seen, and the way along it, longer or shorter.
  EXPECT_GT(std::abs(watch_.drift()(0, 24)), 1e-5);
}

TEST_F(CalibrationWatchTest, FindsEyesOfDifferentFocalLengths) {
  aisle_.calibration[0].disparity_slope = 0.004;
  drive(36);
  EXPECT_NEAR(front().disparity_slope, 0.004, 0.001);
  EXPECT_NEAR(back().disparity_slope, 0, 1e-4);
}

// What is left of a turned right eye once the middle's disparities are right: 0.3 px where rays are
// as far aside as ahead.
TEST_F(CalibrationWatchTest, FindsATurnedRightEye) {
  aisle_.calibration[0].right_turn = {0, 0.0012, 0};
  drive(48);
  EXPECT_NEAR(front().right_turn.y(), 0.0012, 0.0003);
  EXPECT_NEAR(front().disparity_offset, 0, 0.1);
  EXPECT_LT(back().right_turn.norm(), 0.0003);
}

TEST_F(CalibrationWatchTest, FindsAFocalLength) {
  aisle_.calibration[0].focal = 0.006;
  drive(36);
  EXPECT_NEAR(front().focal, 0.006, 0.001);
}

/// Whether a rig of the front pair alone is corrected, whose disparities have that offset.
std::optional<double> found_alone(double offset) {
  SyntheticAisle aisle(0.3, 4, 800);
  aisle.rig.pairs.resize(1);
  aisle.calibration[0].disparity_offset = offset;
  AisleMap made(aisle, {});
  CalibrationWatch watch(CalibrationConfig{}, 1, made.rig);
  std::optional<RigCalibration> found;
  for (int i = 0; i < 12; ++i) {
    made.add(aisle.frame(i, winding(i)), winding(i));
    if (watch.due(made.map)) found = watch.look(made.map, made.rig, {});
  }
  if (!found) return std::nullopt;
  EXPECT_FALSE(watch.latest());
  return found->pairs.front().disparity_offset;
}

TEST_F(CalibrationWatchTest, OfOnePairALargeOffsetAloneIsBelieved) {
  EXPECT_FALSE(found_alone(0));
  EXPECT_FALSE(found_alone(0.5));
  const auto found = found_alone(1.5);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1.5, 0.2);
}

// How much the pairs differ shows, not which of them is wrong: the rig's accuracy is the same for
// both, so each gets half. So short a drive tells it to a half of that accuracy, which therefore
// pulls it back by a fifth.
TEST_F(CalibrationWatchTest, FindsBaselinesThatDiffer) {
  aisle_.calibration[1].baseline = 0.01;
  drive(24);
  ASSERT_GE(changes_, 1);
  const std::vector<PairCalibration> pairs = watch_.latest().value().pairs;
  EXPECT_NEAR(pairs[1].baseline - pairs[0].baseline, 0.01, 0.002);
  EXPECT_NEAR(pairs[1].baseline, 0.005, 0.0015);
}

TEST_F(CalibrationWatchTest, FindsATurnedPair) {
  aisle_.calibration[1].T_nominal_camera.rotation = exp_so3({0, 0.5 * kDegree, 0});
  drive(36);
  // The cameras' y axes point down: a turn of one is that of the other.
  EXPECT_NEAR(latest_turn(1) - latest_turn(0), 0.5, 0.05);
}

// The side camera sees the tag go by as the front pair has the body move: it is the back pair.
TEST_F(CalibrationWatchTest, ATagTellsWhichPairIsTurned) {
  hang_tag();
  aisle_.calibration[1].T_nominal_camera.rotation = exp_so3({0, 0.5 * kDegree, 0});
  drive(36);
  EXPECT_NEAR(latest_turn(1), 0.5, 0.05);
  EXPECT_NEAR(latest_turn(0), 0, 0.05);
}

// Of baselines that are both longer a drive shows nothing, but a tag is a measure. The rig's
// accuracy of 0.3 % is 0.21 % of both together; a deviation of 0.14 % that the tag leaves has 44 %
// of that variance, and 56 % of the 0.4 % are found.
TEST_F(CalibrationWatchTest, ATagIsAMeasureOfLength) {
  hang_tag();
  aisle_.calibration[0].baseline = aisle_.calibration[1].baseline = 0.004;
  drive(36);
  const Eigen::MatrixXd covariance = watch_.known().covariance();
  const Eigen::Index front = PairNumber::kBaseline, back = front + kPairUnknowns;
  const double variance =
      (covariance(front, front) + covariance(back, back) + 2 * covariance(front, back)) / 4;
  EXPECT_LT(std::sqrt(variance), 0.0016);
  const Eigen::VectorXd mean = watch_.known().mean();
  EXPECT_NEAR((mean[front] + mean[back]) / 2, 0.56 * 0.004, 0.0008);
}

// Both pairs turned about the vertical by the same angle are nothing but another body frame, if
// they move with it: no camera can see that.
TEST_F(CalibrationWatchTest, PairsThatMoveTogetherAreAnotherBodyFrame) {
  const Pose turned{exp_so3({0, 0, 0.5 * kDegree}), {0.005, 0, 0}};
  for (std::size_t v = 0; v < 2; ++v) {
    const Pose& nominal = aisle_.rig.pairs[v].T_body_cam;
    aisle_.calibration[v].T_nominal_camera = nominal.inverse() * turned * nominal;
  }
  drive(36);
  EXPECT_EQ(changes_, 0);
}

TEST_F(CalibrationWatchTest, FindsALatePair) {
  aisle_.calibration[1].time = 0.010;
  drive(48);
  EXPECT_NEAR(back().time - front().time, 0.010, 0.0015);
}

// Five standard deviations of what the watch says are 1.5 ms here too.
TEST_F(CalibrationWatchTest, FindsALateTagCamera) {
  hang_tag();
  side_late_ = 0.010;
  drive(48);
  EXPECT_NEAR(side_time(), 0.010, 0.0015);
  EXPECT_NEAR(front().time, 0, 0.0015);
  EXPECT_NEAR(back().time, 0, 0.0015);
}

// That a pair is late shows by the other pair, and that it is this one by the tag camera: for three
// clocks of the same accuracy, of which one is apart from the two others, it is likeliest alone.
TEST_F(CalibrationWatchTest, ATagTellsWhichPairIsLate) {
  hang_tag();
  aisle_.calibration[1].time = 0.010;
  drive(48);
  EXPECT_NEAR(back().time - front().time, 0.010, 0.0015);
  EXPECT_NEAR(side_time() - front().time, 0, 0.0015);
  EXPECT_GT(back().time, 0.0067 - 0.0015);  // at least as the mean of the three has it
}

TEST_F(CalibrationWatchTest, FindsARollingShutter) {
  aisle_.calibration[0].readout = 0.03;
  drive(48);
  EXPECT_NEAR(front().readout, 0.03, 0.005);
}

// The body turns by 0.1 rad/s, root mean square, and is thought to turn by 0.05 more or less about
// each axis. Who takes that for the truth finds half of the readout in the first look, and believes
// it to 3 ms.
TEST_F(CalibrationWatchTest, AReadoutIsNotFoundByVelocitiesThatAreThoughtToBeExact) {
  aisle_.calibration[0].readout = aisle_.calibration[1].readout = 0.03;
  speed_ = 0.25;
  velocity_noise_ = 0.05;
  drive(6);
  const double sigma =
      std::sqrt(watch_.error(made_.rig)(PairNumber::kReadout, PairNumber::kReadout));
  EXPECT_GT(sigma, 0.006);
  EXPECT_LT(std::abs(front().readout - 0.03), 4 * sigma);
  drive(42);
  EXPECT_NEAR(front().readout, 0.03, 0.006);
  EXPECT_NEAR(back().readout, 0.03, 0.006);
}

// Baselines that are all wrong by the same share make a map of another size, and nothing else.
TEST_F(CalibrationWatchTest, WhatADriveDoesNotShowStaysWhereTheRigHasIt) {
  aisle_.calibration[0].baseline = aisle_.calibration[1].baseline = 0.01;
  drive(36);
  EXPECT_EQ(changes_, 0);
}

// After four dozens with the right calibration a knock: the first dozen after it may be an
// accident, the second one is not.
TEST_F(CalibrationWatchTest, AKnockIsFoundWithinTwoLooks) {
  drive(48);
  EXPECT_EQ(changes_, 0);
  aisle_.calibration[1].disparity_offset = 1.5;
  drive(12);
  EXPECT_EQ(changes_, 0);
  drive(12);
  EXPECT_EQ(changes_, 1);
  EXPECT_NEAR(back().disparity_offset, 1.5, 0.15);
}

// Errors of another kind make dozens differ; a knock makes them differ in one way.
TEST_F(CalibrationWatchTest, DozensThatContradictEachOtherTooAreNoKnock) {
  drive(48);
  aisle_.calibration[1].disparity_offset = 1.5;
  drive(12);
  aisle_.calibration[1].disparity_offset = -1.5;
  drive(12);
  EXPECT_EQ(changes_, 0);
  drive(12);
  EXPECT_EQ(changes_, 1);
  EXPECT_NEAR(back().disparity_offset, -1.5, 0.15);
}

// The back pair is 30 ms late, as is known. How fast the body went meanwhile is known less well:
// turns that are 8 % slower than thought make the pair seem 2.4 ms early, a dozen times what its
// pixels leave open.
TEST_F(CalibrationWatchTest, WhatTheVelocityHasWrongIsNoErrorOfTheCalibration) {
  aisle_.calibration[1].time = told_late_ = 0.03;
  drive(96);
  EXPECT_EQ(changes_, 0);
}

TEST_F(CalibrationWatchTest, LooksEveryDozenAndLaterEveryFourth) {
  Map map(OrbConfig{}.scale);
  std::vector<int> due;
  for (int i = 1; i < 200; ++i) {
    map.add_keyframe(std::make_shared<FrameFeatures>(), {}, {});
    if (!watch_.due(map)) continue;
    due.push_back(i);
    // Keyframes that see nothing say nothing.
    EXPECT_FALSE(watch_.look(map, made_.rig, {}));
  }
  EXPECT_EQ(due, (std::vector<int>{6, 12, 24, 36, 48, 60, 72, 84, 96, 144, 192}));
}

}  // namespace
}  // namespace vinebench::slam
