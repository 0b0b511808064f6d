// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/loop_judge.h"

#include <gtest/gtest.h>

#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

using test::record_of;

LoopVerdict verdict_of(double at, const LoopClosure& closure) {
  return judge_loop_closures(record_of([=](Estimate& estimate) {
    if (estimate.stamp == test::seconds(at)) estimate.loop_closure = closure;
  }));
}

TEST(LoopJudgeTest, AgreementWithTheTruthIsCorrect) {
  const LoopVerdict verdict =
      verdict_of(19, test::fake_closure(test::seconds(1), test::seconds(19)));
  EXPECT_EQ(verdict.correct(), 1);
  EXPECT_EQ(verdict.wrong(), 0);
  EXPECT_TRUE(verdict.missed.empty());
  ASSERT_EQ(verdict.closures.size(), 1u);
  EXPECT_NEAR(verdict.closures[0].error_m, 0, 1e-12);
}

TEST(LoopJudgeTest, TenCentimetresDecide) {
  const auto off_by = [](double metres) {
    return verdict_of(19, test::fake_closure(test::seconds(1), test::seconds(19), metres));
  };
  EXPECT_EQ(off_by(0.09).correct(), 1);
  EXPECT_EQ(off_by(0.11).wrong(), 1);
}

TEST(LoopJudgeTest, TwoDegreesDecide) {
  const auto turned_by = [](double degrees) {
    LoopClosure closure = test::fake_closure(test::seconds(1), test::seconds(19));
    closure.T_earlier_later.rotation =
        (closure.T_earlier_later.rotation *
         from_roll_pitch_yaw({degrees * std::numbers::pi / 180, 0, 0}))
            .normalized();
    return verdict_of(19, closure);
  };
  EXPECT_EQ(turned_by(1.9).correct(), 1);
  EXPECT_EQ(turned_by(2.1).wrong(), 1);
}

TEST(LoopJudgeTest, FramesThatNeverWereAreWrong) {
  const LoopVerdict verdict =
      verdict_of(19, test::fake_closure(test::seconds(1) + 5, test::seconds(19)));
  EXPECT_EQ(verdict.wrong(), 1);
}

TEST(LoopJudgeTest, AReturnWithoutAClosureIsMissed) {
  const LoopVerdict verdict = judge_loop_closures(record_of({}));
  ASSERT_EQ(verdict.missed.size(), 1u);
  EXPECT_EQ(verdict.missed[0].first, 180u);  // 18 s at 10 Hz
  EXPECT_EQ(verdict.missed[0].last, 200u);
}

// The truth has the tag in view at the beginning and from 18 s on; a detector may find it at a
// distance before that. A closure during the first view does not count for its return.
TEST(LoopJudgeTest, AClosureSinceTheTagWasLeftBelongsToItsReturn) {
  const auto missed_with = [](double at) {
    return verdict_of(at, test::fake_closure(test::seconds(0.5), test::seconds(at))).missed.size();
  };
  EXPECT_EQ(missed_with(19), 0u);
  EXPECT_EQ(missed_with(16.5), 0u);
  EXPECT_EQ(missed_with(1), 1u);
}

TEST(LoopJudgeTest, AnotherTagsClosureDoesNotCount) {
  LoopClosure other = test::fake_closure(test::seconds(1), test::seconds(19));
  other.tag_id = 8;
  EXPECT_EQ(verdict_of(19, other).missed.size(), 1u);
}

// The way back passes one tag from 16 to 18 s, where the loop is closed, and then another one. If
// both are registered, the second adds no information; an unregistered tag does.
TEST(LoopJudgeTest, ARegisteredTagSoonAfterAnotherIsNoReturnOfItsOwn) {
  RunRecord record = record_of([](Estimate& estimate) {
    if (estimate.stamp != test::seconds(17)) return;
    estimate.loop_closure = test::fake_closure(test::seconds(1), test::seconds(17));
  });
  for (Tick& tick : record.ticks) {
    const double t = to_seconds(tick.stamp);
    tick.truth.visible_tags.clear();
    if (t <= 2 || (t >= 16 && t <= 18)) tick.truth.visible_tags.push_back(0);
    if (t <= 2 || t >= 18) tick.truth.visible_tags.push_back(1);
  }
  record.tags.push_back(record.tags.front());
  record.tags.back().id = record.tags.front().id + 1;
  EXPECT_TRUE(judge_loop_closures(record).missed.empty());
  record.tags.back().registered = false;
  const LoopVerdict mapped = judge_loop_closures(record);
  ASSERT_EQ(mapped.missed.size(), 1u);
  EXPECT_EQ(mapped.missed[0].tag, 1);
}

// Views: 0-2 s, 3-4 s (a gap of 1 s: the same visit) and 18-20 s with one frame missing.
TEST(LoopJudgeTest, ShortGapsBelongToTheVisit) {
  RunRecord record = record_of({});
  for (Tick& tick : record.ticks) {
    const double t = to_seconds(tick.stamp);
    const bool seen = t <= 2 || (t >= 3 && t <= 4) || (t >= 18 && tick.index != 188);
    tick.truth.visible_tags = seen ? std::vector<int>{0} : std::vector<int>{};
  }
  const std::vector<TagVisit> visits = tag_visits(record);
  ASSERT_EQ(visits.size(), 2u);
  EXPECT_EQ(visits[0].last, 40u);
  EXPECT_EQ(visits[0].longest, test::seconds(2));
  EXPECT_EQ(visits[1].longest, test::seconds(1.1));  // frames 189 to 200
}

TEST(LoopJudgeTest, AGlimpseNeedNotBeNoticed) {
  RunRecord record = record_of({});
  for (Tick& tick : record.ticks) {
    if (to_seconds(tick.stamp) > 18.8) tick.truth.visible_tags.clear();
  }
  EXPECT_TRUE(judge_loop_closures(record).missed.empty());
}

// A stationary rover whose tag is hidden for a while has closed no loop.
TEST(LoopJudgeTest, AVisitNeedsAWayWithoutTheTag) {
  RunRecord record = record_of({});
  for (Tick& tick : record.ticks) tick.truth.T_world_body = test::circle(0);
  EXPECT_EQ(tag_visits(record).size(), 1u);
}

// A covariance of nearly nothing leaves the floor of 5 mm and half a degree along and about each
// axis: 24 mm are 4.8 of them, and 4.8^2 = 23.04 is above 22.458; 23 mm are 4.6, 21.16. With 10 mm
// of its own, 24 mm are 24 / sqrt(125) = 2.15. 11 cm are wrong whatever the covariance.
TEST(LoopJudgeTest, TheCovarianceDecidesAboveItsFloor) {
  const auto correct = [](double offset, double sigma) {
    LoopClosure closure = test::fake_closure(test::seconds(1), test::seconds(19), offset);
    closure.covariance = Matrix6d::Identity() * sigma * sigma;
    return verdict_of(19, closure).correct() == 1;
  };
  EXPECT_TRUE(correct(0.023, 1e-9));
  EXPECT_FALSE(correct(0.024, 1e-9));
  EXPECT_TRUE(correct(0.024, 0.01));
  EXPECT_FALSE(correct(0.11, 1));
}

// Neighbouring frames have no loop between them: right, but no loop closure, and the return from
// 18 s on is still missed.
TEST(LoopJudgeTest, ClosuresOfNeighbouringFramesCountForNothing) {
  const LoopVerdict verdict =
      verdict_of(19.1, test::fake_closure(test::seconds(19), test::seconds(19.1)));
  EXPECT_EQ(verdict.correct(), 0);
  EXPECT_EQ(verdict.wrong(), 0);
  EXPECT_EQ(verdict.missed.size(), 1u);
  EXPECT_EQ(verdict.returns, 1);
}

TEST(LoopJudgeTest, AWrongClosureDoesNotMakeUpForAMissedOne) {
  const LoopVerdict verdict =
      verdict_of(19, test::fake_closure(test::seconds(1), test::seconds(19), 0.5));
  EXPECT_EQ(verdict.wrong(), 1);
  EXPECT_EQ(verdict.missed.size(), 1u);
}

// A camera with a view of 90 degrees looks ahead from every pose of the circle. The tag is 1 m
// ahead of the first pose, and of no other: a closure between other frames names a tag that cannot
// be there, however well it agrees with the truth.
TEST(LoopJudgeTest, ATagMustBeInViewAtBothEnds) {
  RunRecord record = record_of({});
  record.rig.cameras[2].model = {
      .width = 101, .height = 101, .fx = 50, .fy = 50, .cx = 50, .cy = 50};
  record.rig.cameras[2].T_body_cam = Rig::mount({0, 0, 0}, {0, 0, 0});
  record.rig.tag_cameras = {2};
  // Its z axis, into the tag, is the camera's.
  record.tags[0].T_world_tag = test::circle(0) * Rig::mount({1, 0, 0}, {0, 0, 0});
  for (Tick& tick : record.ticks) tick.truth.visible_tags.clear();
  const auto wrong = [&](double earlier, double later) {
    RunRecord closed = record;
    closed.ticks[190].estimate.loop_closure =
        test::fake_closure(test::seconds(earlier), test::seconds(later));
    return judge_loop_closures(closed).wrong();
  };
  EXPECT_EQ(wrong(0, 20), 0);  // the circle's end is its beginning
  EXPECT_EQ(wrong(0, 10), 1);
  EXPECT_EQ(wrong(10, 20), 1);
}

TEST(LoopJudgeTest, AClosureByAppearanceNeedsNoTag) {
  RunRecord record = record_of({});
  record.rig.tag_cameras = {2};
  LoopClosure closure = test::fake_closure(test::seconds(5), test::seconds(15));
  record.ticks[150].estimate.loop_closure = closure;
  EXPECT_EQ(judge_loop_closures(record).wrong(), 1);
  record.ticks[150].estimate.loop_closure->tag_id = -1;
  EXPECT_EQ(judge_loop_closures(record).correct(), 1);
}

}  // namespace
}  // namespace vinebench::harness
