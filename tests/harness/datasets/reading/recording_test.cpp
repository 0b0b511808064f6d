// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/recording.h"

#include <gmock/gmock.h>

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Recording frame_at_100(std::vector<Stamp> delays, std::vector<Stamp> image_stamps = {}) {
  Recording recording;
  recording.image_delays = std::move(delays);
  recording.frames.push_back({100, {"left", "right"}, {}, std::move(image_stamps)});
  return recording;
}

TEST(DelayImages, FramesFollowTheFirstCamera) {
  Recording alike = frame_at_100({7, 7});
  delay_images(alike);
  EXPECT_EQ(alike.frames[0].stamp, 107);
  EXPECT_THAT(alike.frames[0].image_stamps, IsEmpty());
  delay_images(alike);  // once is enough
  EXPECT_EQ(alike.frames[0].stamp, 107);

  Recording apart = frame_at_100({-7, 2});
  delay_images(apart);
  EXPECT_EQ(apart.frames[0].stamp, 93);
  EXPECT_THAT(apart.frames[0].image_stamps, ElementsAre(93, 102));
}

TEST(DelayImages, ImagesKeepTheirOwnStamps) {
  Recording recording = frame_at_100({1, 2}, {100, 130});
  delay_images(recording);
  EXPECT_EQ(recording.frames[0].stamp, 101);
  EXPECT_THAT(recording.frames[0].image_stamps, ElementsAre(101, 132));
  Recording none = frame_at_100({}, {100, 130});
  delay_images(none);
  EXPECT_THAT(none.frames[0].image_stamps, ElementsAre(100, 130));
}

}  // namespace
}  // namespace vinebench::harness
