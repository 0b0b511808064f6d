// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/frame_stream.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

class FrameStreamTest : public test::SmallScenario {
 protected:
  StreamRequest stream_request() const {
    StreamRequest request;
    request.machine = request_.machine;
    request.scenario = request_.scenario;
    return request;
  }
};

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST_F(FrameStreamTest, GivesEveryFrameAndThenNothing) {
  FrameStream stream(stream_request());
  for (std::int64_t i = 0; i < stream.size(); ++i) {
    const auto frame = stream.next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->number, i);
    EXPECT_EQ(frame->frame.images.size(), stream.rig().cameras.size());
    EXPECT_TRUE(frame->truth.views.empty());
  }
  EXPECT_EQ(stream.next(), nullptr);
  EXPECT_EQ(stream.next(), nullptr);
}

TEST_F(FrameStreamTest, SomeFramesAndCamerasAreThoseOfTheWholeRun) {
  FrameStream whole(stream_request());
  StreamRequest request = stream_request();
  request.first = 1;
  request.every = 2;
  request.cameras = {"side"};
  request.truth = {"depth"};
  request.threads = 1;
  FrameStream some(request);
  whole.next();
  const auto expected = whole.next();
  const auto frame = some.next();
  const auto side = static_cast<std::size_t>(some.rig().find_camera("side"));
  EXPECT_EQ(frame->frame.index, 1);
  EXPECT_EQ(frame->frame.stamp, expected->frame.stamp);
  EXPECT_TRUE(same(frame->frame.images[side], expected->frame.images[side]));
  EXPECT_TRUE(frame->frame.images[0].empty());
  EXPECT_FALSE(frame->truth.views[side].image.depth.empty());
  EXPECT_EQ(some.next()->frame.index, 3);
}

TEST_F(FrameStreamTest, TruthThatWasNotAskedForIsAnError) {
  FrameStream stream(stream_request());
  const auto first = stream.next();
  const auto second = stream.next();
  EXPECT_THAT(error_of([&] { stream.things(*first, 0); }), HasSubstr("truth \"things\""));
  EXPECT_THAT(error_of([&] { stream.flow(*first, *second, 0); }), HasSubstr("truth \"flow\""));
}

TEST_F(FrameStreamTest, BadRequestsAreOneError) {
  StreamRequest request = stream_request();
  request.truth = {"colour"};
  EXPECT_THAT(error_of([&] { FrameStream{request}; }), HasSubstr("unknown 'colour'"));
  request = stream_request();
  request.cameras = {"top"};
  EXPECT_THAT(error_of([&] { FrameStream{request}; }), HasSubstr("no camera named 'top'"));
  request = stream_request();
  request.first = 4000;
  EXPECT_THAT(error_of([&] { FrameStream{request}; }), HasSubstr("no frame from 4000 on"));
  request.last = 3000;
  EXPECT_THAT(error_of([&] { FrameStream{request}; }), HasSubstr("first <= last"));
}

}  // namespace
}  // namespace vinebench::harness
