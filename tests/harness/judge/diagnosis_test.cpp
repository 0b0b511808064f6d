// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/steady_drive.h"

namespace vinebench::harness {
namespace {

using test::weaken;
using testing::ElementsAre;
using testing::HasSubstr;

/// Most of both front cameras' images.
void cover_front(Tick& tick, OccluderClass occluder) {
  for (const std::size_t camera : {0, 1}) tick.truth.occlusion[camera].share(occluder) = 0.9;
}

class DiagnosisTest : public test::SteadyDrive {
 protected:
  std::vector<DegradedSegment> found() const {
    return diagnose(record_, measure(record_, {}), trial_);
  }
  std::vector<Cause> causes() const {
    std::vector<Cause> list;
    for (const DegradedSegment& explanation : found()) list.push_back(explanation.cause);
    return list;
  }
};

TEST_F(DiagnosisTest, AGoodRunHasNothingToExplain) {
  EXPECT_TRUE(found().empty());
  EXPECT_THAT(format_diagnosis(record_, {}), HasSubstr("no degraded segment"));
  EXPECT_TRUE(diagnose({}, {}, trial_).empty());
}

TEST_F(DiagnosisTest, AnEstimateThatNeverBeganIsNotCalledGood) {
  for (Tick& tick : record_.ticks) {
    tick.estimate.status = TrackingStatus::kInitializing;
    tick.estimate.T_map_body.reset();
  }
  EXPECT_THAT(format_diagnosis(record_, found()), HasSubstr("there was never a pose"));
}

TEST_F(DiagnosisTest, WithoutTruthNothingIsKnown) {
  for (Tick& tick : record_.ticks) tick.truth.known = false;
  EXPECT_THAT(format_diagnosis(record_, found()), HasSubstr("the truth is not known"));
}

TEST_F(DiagnosisTest, WeakTrackingBehindACartonIsOcclusion) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    cover_front(tick, OccluderClass::kCarton);
    tick.estimate.cameras[0].features = 20;  // not a lack of texture: a carton occludes it
  });
  const auto list = found();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].cause, Cause::kOcclusion);
  EXPECT_EQ(list[0].first, 100u);
  EXPECT_EQ(list[0].last, 120u);
  EXPECT_THAT(list[0].cameras, ElementsAre(0));  // a pair's left camera represents both
  EXPECT_EQ(list[0].share, 1);
  EXPECT_EQ(list[0].inliers, 20);
  EXPECT_EQ(list[0].usual_inliers, 180);
  EXPECT_EQ(list[0].error_growth, 0);
  EXPECT_THAT(format_diagnosis(record_, list),
              HasSubstr("10.00 to 12.00 s: occlusion by carton in front_left (100 % of the time)"));
}

TEST_F(DiagnosisTest, TheClassThatCoversMostIsNamed) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    // Together 0.6, past the half at which a camera counts as occluded; neither is alone.
    tick.truth.occlusion[0].share(OccluderClass::kCrate) = 0.2;
    tick.truth.occlusion[0].share(OccluderClass::kPerson) = 0.4;
  });
  const auto list = found();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].cause, Cause::kOcclusion);
  EXPECT_EQ(list[0].occluder, OccluderClass::kPerson);
  EXPECT_THAT(format_diagnosis(record_, list), HasSubstr("occlusion by person in front_left"));
}

TEST_F(DiagnosisTest, LosingTrackIsSuffering) {
  meanwhile([](Tick& tick) {
    tick.estimate.status = TrackingStatus::kLost;
    tick.estimate.T_map_body.reset();
    tick.delivered[0] = false;
  });
  const auto list = found();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].cause, Cause::kDroppedImages);
  EXPECT_EQ(list[0].untracked, 21);
}

TEST_F(DiagnosisTest, FewFeaturesInAClearViewAreLittleTexture) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.estimate.cameras[0].features = 150;  // the median is 500
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kLittleTexture));
}

// 0.5 m/s at 1 m and 300 px: 150 px/s; in 20 ms 3 px, in 10 ms 1.5 px.
TEST_F(DiagnosisTest, MotionBlurIsCountedInPixels) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.truth.blur_time = {0.020, 0.020, 0};
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kMotionBlur));
  meanwhile([](Tick& tick) { tick.truth.blur_time = {0.010, 0.010, 0}; });
  EXPECT_THAT(causes(), ElementsAre(Cause::kUnexplained));
}

/// How the images of the left camera were taken.
std::vector<Capture> captures(const Capture& left) {
  return {left, {}, {}};
}

TEST_F(DiagnosisTest, SaturatedImagesAreABadExposure) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.brightness = {{.dark = 0, .saturated = 0.6}, {}, {}};
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kExposure));
  EXPECT_THAT(format_diagnosis(record_, found()), HasSubstr("exposure in front_left"));
}

TEST_F(DiagnosisTest, MuchGainIsABadExposure) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.truth.captures = captures({.gain_db = 20});
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kExposure));
}

// 150 px/s at 1 m: 3 px in 20 ms; 0.75 px in 5 ms, of which half a pixel is too much.
TEST_F(DiagnosisTest, ShutterAndTimesAreCountedInPixels) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.truth.captures = captures({.readout_time = 0.020});
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kRollingShutter));
  meanwhile([](Tick& tick) { tick.truth.captures = captures({.stamp_error = 0.005}); });
  EXPECT_THAT(causes(), ElementsAre(Cause::kTimeOffset));
}

// A tenth of the image is too little for an occlusion; a person who stands is no moving object.
TEST_F(DiagnosisTest, SomeoneWhoWalksThroughTheViewIsAMovingObject) {
  trial_.site.objects = {{.kind = OccluderClass::kPerson, .moves = true}};
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.truth.occlusion[0].share(OccluderClass::kPerson) = 0.1;
  });
  ASSERT_THAT(causes(), ElementsAre(Cause::kMovingObjects));
  EXPECT_EQ(found()[0].occluder, OccluderClass::kPerson);
  trial_.site.objects[0].moves = false;
  EXPECT_THAT(causes(), ElementsAre(Cause::kUnexplained));
  trial_.site.objects[0].moves = true;
  meanwhile([](Tick& tick) { tick.truth.occlusion[0].share(OccluderClass::kPerson) = 0.6; });
  EXPECT_THAT(causes(), ElementsAre(Cause::kOcclusion));
}

TEST_F(DiagnosisTest, AnErrorThatGrowsFastIsFoundWithoutWeakTracking) {
  slide();
  EXPECT_THAT(causes(), ElementsAre(Cause::kUnexplained));
}

TEST_F(DiagnosisTest, ARightCorrectionIsNoGrowth) {
  slide();
  record_.ticks[110].estimate.loop_closure = LoopClosure{};
  RunResults results;
  JudgedClosure& closure = results.loops.closures.emplace_back();
  closure.tick = 110;
  closure.correct = true;
  for (std::size_t i = 100; i < record_.ticks.size(); ++i) {
    record_.ticks[i].estimate.T_map_body->translation.y() = i < 110 ? 0 : 0.1;
  }
  EXPECT_TRUE(diagnose(record_, results, trial_).empty());
  closure.correct = false;
  const auto list = diagnose(record_, results, trial_);
  ASSERT_FALSE(list.empty());
  EXPECT_EQ(list[0].cause, Cause::kWrongTag);
}

TEST_F(DiagnosisTest, AMiscalibratedRigIsBlamedForWhatNothingElseExplains) {
  trial_.miscalibrated = true;
  slide();
  EXPECT_THAT(causes(), ElementsAre(Cause::kCalibrationError));
  meanwhile([](Tick& tick) { cover_front(tick, OccluderClass::kCarton); });
  EXPECT_THAT(causes(), ElementsAre(Cause::kOcclusion));
}

// A map 2 % too large: 10 mm in each second of 0.5 m, and never more than usual.
TEST_F(DiagnosisTest, ASteadyDriftOfTheWholeRunIsSuffering) {
  for (Tick& tick : record_.ticks) tick.estimate.T_map_body->translation *= 1.02;
  trial_.miscalibrated = true;
  const auto list = found();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].cause, Cause::kCalibrationError);
  EXPECT_NEAR(list[0].error_growth, 0.2, 0.01);  // m, 2 % of 10 m
  // Half a percent is 2.5 mm a second: the normal drift of a good system.
  for (Tick& tick : record_.ticks) tick.estimate.T_map_body->translation *= 1.005 / 1.02;
  EXPECT_TRUE(found().empty());
}

// Plants are 1 m apart along the row, which leads east: a jump forward by 2.05 m is two spacings.
TEST_F(DiagnosisTest, AJumpByPlantsIsARepeatedPattern) {
  const auto jump = [&](double x, double y) {
    for (std::size_t i = 110; i < record_.ticks.size(); ++i) {
      record_.ticks[i].estimate.T_map_body->translation =
          record_.ticks[i].truth.T_world_body.translation + Eigen::Vector3d(x, y, 0);
    }
    return causes();
  };
  EXPECT_THAT(jump(2.05, 0.05), ElementsAre(Cause::kRepeatedPattern));
  EXPECT_THAT(jump(-1, 0), ElementsAre(Cause::kRepeatedPattern));
  EXPECT_THAT(jump(1.5, 0), ElementsAre(Cause::kUnexplained));
  EXPECT_THAT(jump(1, 0.5), ElementsAre(Cause::kUnexplained));
  for (Tick& tick : record_.ticks) {
    if (tick.index >= 105 && tick.index <= 130) weaken(tick);
  }
  EXPECT_THAT(jump(1, 0), ElementsAre(Cause::kUnexplained));  // no matches, no pattern
}

TEST_F(DiagnosisTest, TagsMayBeMissedOrWrong) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    tick.truth.visible_tags = {0};
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kMissedTag));
  meanwhile([](Tick& tick) {
    tick.truth.visible_tags.clear();
    tick.estimate.rejected_tags.push_back({"tag36h11", 7, 2, TagRejection::kMisplaced});
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kWrongTag));
  meanwhile([](Tick& tick) { tick.estimate.rejected_tags[0].reason = TagRejection::kAmbiguous; });
  EXPECT_THAT(causes(), ElementsAre(Cause::kUnexplained));
}

TEST_F(DiagnosisTest, SeveralCausesComeStrongestFirst) {
  meanwhile([](Tick& tick) {
    weaken(tick);
    cover_front(tick, OccluderClass::kCarton);
    if (tick.index <= 110) tick.delivered[0] = false;  // 11 of 21 ticks
  });
  EXPECT_THAT(causes(), ElementsAre(Cause::kOcclusion, Cause::kDroppedImages));
}

}  // namespace
}  // namespace vinebench::harness
