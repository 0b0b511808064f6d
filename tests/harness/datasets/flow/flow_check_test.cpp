// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/flow/flow_check.h"

#include <gmock/gmock.h>

#include "core/truth/labels.h"
#include "tests/support/label_folder.h"

namespace vinebench::harness {
namespace {

using test::LabelFolder;
using testing::ElementsAre;
using testing::IsEmpty;

/// The camera rests between the frames, so that flow is 0 px: code 2^15, blue 1 where it is known.
class FlowCheckTest : public testing::Test {
 protected:
  FlowCheckTest() { folder_.put("depth", LabelFolder::filled(CV_16UC1, 2000)); }

  /// Of 12 pixels so many have a flow of one pixel to the right: 64 steps.
  void put_flow(int wrong) const {
    cv::Mat flow = LabelFolder::filled(CV_16UC3, {1, 32768, 32768});  // BGR: known, v, u
    for (int i = 0; i < wrong; ++i) flow.at<cv::Vec3w>(i / 4, i % 4)[2] = 32768 + 64;
    folder_.put("flow", flow);
  }
  LabelFolder folder_;
};

TEST_F(FlowCheckTest, NineTenthsOfThePixelsMustAgree) {
  put_flow(1);  // 11 of 12 are 92 %
  EXPECT_THAT(folder_.faults_of(check_flow_image), IsEmpty());
  put_flow(2);  // 10 of 12 are 83 %
  EXPECT_THAT(folder_.faults_of(check_flow_image),
              ElementsAre("flow/left/000000.png: agrees with depth and poses at 10 of 12 pixels"));
}

TEST_F(FlowCheckTest, WhatMayMoveIsLeftOut) {
  put_flow(12);
  folder_.put("semantic", LabelFolder::filled(CV_8UC1, static_cast<int>(Label::kLeaf)));
  EXPECT_FALSE(folder_.faults_of(check_flow_image).empty());  // in still air leaves are at rest
  folder_.sequence().windy = true;
  EXPECT_THAT(folder_.faults_of(check_flow_image), IsEmpty());
  folder_.put("semantic", LabelFolder::filled(CV_8UC1, static_cast<int>(Label::kPost)));
  EXPECT_FALSE(folder_.faults_of(check_flow_image).empty());
}

TEST_F(FlowCheckTest, OccludersMoveOnlyWhereOneHasAPath) {
  put_flow(12);
  folder_.put("semantic", LabelFolder::filled(CV_8UC1, static_cast<int>(Label::kPerson)));
  EXPECT_FALSE(folder_.faults_of(check_flow_image).empty());
  folder_.sequence().busy = true;
  EXPECT_THAT(folder_.faults_of(check_flow_image), IsEmpty());
}

TEST_F(FlowCheckTest, TheLastFrameHasNone) {
  put_flow(12);
  folder_.sequence().frames.pop_back();
  EXPECT_THAT(folder_.faults_of(check_flow_image), IsEmpty());
}

}  // namespace
}  // namespace vinebench::harness
