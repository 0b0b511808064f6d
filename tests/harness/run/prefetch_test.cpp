// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/prefetch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/util/error.h"
#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

TEST(PrefetchTest, GivesTheSourcesSamplesInOrder) {
  test::FakeSource alone(1, 20);
  test::FakeSource source(1, 20);
  Prefetch ahead(source);
  EXPECT_EQ(ahead.size(), 20);
  for (int i = 0; i < 20; ++i) {
    const auto expected = alone.next();
    const auto sample = ahead.next();
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->frame.index, i);
    EXPECT_EQ(cv::norm(sample->frame.images[0], expected->frame.images[0], cv::NORM_INF), 0);
  }
  EXPECT_FALSE(ahead.next());
  EXPECT_FALSE(ahead.next());
  ahead.times();  // nothing is pending: must not block
}

TEST(PrefetchTest, MayBeLeftBeforeTheEnd) {
  test::FakeSource source(1, 20);
  {
    Prefetch ahead(source);
    ahead.next();
  }
  // One was returned, one was pending: the source continues with the third.
  EXPECT_EQ(source.next()->frame.index, 2);
}

class Failing : public test::FakeSource {
 public:
  std::optional<Sample> next() override {
    auto sample = test::FakeSource::next();
    if (sample->frame.index == 2) fail("the third one is broken");
    return sample;
  }
};

TEST(PrefetchTest, AnErrorComesInItsTurn) {
  Failing source;
  Prefetch ahead(source);
  EXPECT_TRUE(ahead.next());
  EXPECT_TRUE(ahead.next());
  EXPECT_THAT([&] { ahead.next(); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("the third one")));
  EXPECT_FALSE(ahead.next());
}

}  // namespace
}  // namespace vinebench::harness
