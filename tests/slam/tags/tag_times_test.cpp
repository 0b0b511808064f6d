// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_times.h"

#include <gtest/gtest.h>

#include "slam/features/orb_extractor.h"
#include "slam/tags/tag_sightings.h"
#include "tests/support/synthetic_aisle.h"

namespace vinebench::slam {
namespace {

using test::SyntheticAisle;

/// A keyframe of a moving body, whose side camera sees a tag 1 m ahead of it.
class TagTimesTest : public testing::Test {
 protected:
  TagTimesTest() {
    aisle_.velocity << 0.4, 0.05, 0, 0, 0, 0.5;
    map_.add_keyframe(seen_at(0), {}, {});
  }
  /// That many seconds after the frame's stamp.
  std::shared_ptr<FrameFeatures> seen_at(double late) const {
    const Pose T_world_tag = camera().T_body_cam * Pose{{1, 0, 0, 0}, {0.1, 0, 1}};
    return aisle_.frame_with_tag(0, step_of(aisle_.velocity * late), T_world_tag);
  }
  const RigCamera& camera() const { return aisle_.rig.cameras[static_cast<std::size_t>(side_)]; }
  const TagSighting& sighting() const { return map_.keyframe(0).frame->tags.front(); }

  SyntheticAisle aisle_{0, 1, 0};
  TagCameras cameras_{aisle_.rig.cameras};
  int side_ = aisle_.rig.tag_cameras.front();
  Map map_{OrbConfig{}.scale};
};

// What was taken 10 ms later was seen 10 ms nearer to the tag than the body is at the frame's
// stamp.
TEST_F(TagTimesTest, SightingsAreBroughtToTheirFramesAnew) {
  map_.add_keyframe(seen_at(0.010), {}, {});
  const auto as_it_was = map_.keyframe(1).frame;
  take_tags_later(side_, 0.010, cameras_, map_);
  const TagSighting mended = map_.keyframe(1).frame->tags.front();
  const TagSighting now = seen_at(0)->tags.front();
  EXPECT_LT((mended.corners[2] - now.corners[2]).norm(), 1e-6);  // px, of undistortion
  EXPECT_LT((mended.T_cam_tag.translation - now.T_cam_tag.translation).norm(), 1e-12);
  EXPECT_EQ(mended.late, 0);
  EXPECT_EQ(as_it_was->tags.front().corners, seen_at(0.010)->tags.front().corners);
}

TEST_F(TagTimesTest, WhatWasTakenBackIsAsBefore) {
  const TagSighting before = sighting();
  take_tags_later(side_, 0.010, cameras_, map_);
  EXPECT_GT((sighting().corners[0] - before.corners[0]).norm(), 1);  // px: 4 mm at 1 m are 3
  take_tags_later(side_, -0.010, cameras_, map_);
  // A turn of 5 mrad and a way of 4 mm do not commute by 1e-5 m, a hundredth of a pixel.
  EXPECT_LT((sighting().corners[0] - before.corners[0]).norm(), 0.02);
}

TEST_F(TagTimesTest, AnotherCamerasSightingsStay) {
  const auto before = map_.keyframe(0).frame;
  take_tags_later(side_ - 1, 0.010, cameras_, map_);
  take_tags_later(side_, 0, cameras_, map_);
  EXPECT_EQ(map_.keyframe(0).frame, before);
}

}  // namespace
}  // namespace vinebench::slam
