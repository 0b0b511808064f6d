// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "slam/loop/loop_closer.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam::test_case {

using test::SyntheticAisle;

/// A loop closer in a synthetic aisle, and tags that its side camera sees.
class LoopCloserTest : public testing::Test {
 protected:
  static constexpr std::size_t kSide = 4;  ///< index of the rover's tag camera

  LoopCloser closer(const std::vector<RegisteredTag>& tags = {}) const {
    return {settings_, rig_.tag_cameras, tags};
  }

  /// A sighting of a tag that stands at T_body_tag.
  TagSighting sighting(int id, const Pose& T_body_tag) const {
    TagSighting seen;
    seen.camera = static_cast<int>(kSide);
    seen.family = "tag36h11";
    seen.id = id;
    seen.T_cam_tag = rig_.rig.cameras[kSide].T_body_cam.inverse() * T_body_tag;
    return seen;
  }

  TagSighting with_corners(TagSighting seen) const {
    const RigCamera& side = rig_.rig.cameras[kSide];
    for (std::size_t c = 0; c < 4; ++c) {
      seen.corners[c] = side.model.project(seen.T_cam_tag * tag_corners(0.161)[c]);
    }
    return seen;
  }

  std::shared_ptr<const FrameFeatures> frame(std::int64_t index,
                                             const std::vector<TagSighting>& tags) const {
    auto features = std::make_shared<FrameFeatures>();
    features->index = index;
    features->stamp = stamp_of_frame(index, 15);
    features->tags = tags;
    return features;
  }

  SyntheticAisle aisle_{0, 1, 600};
  EstimatorRig rig_{aisle_.rig, OrbConfig{}};
  LoopCloserSettings settings_;
  Map map_{1.2};
  const Pose T_body_tag_{exp_so3({-1.5, 0.2, 0.1}), {0.1, -0.7, 0.5}};
  const Pose body_{exp_so3({0, 0, 0.4}), {2, 1, 0}};
};

}  // namespace vinebench::slam::test_case
