// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/loop_closer_case.h"

namespace vinebench::slam::test_case {

/// Loops that are closed.
class LoopClosureTest : public LoopCloserTest {
 protected:
  LoopClosureTest() : known_(aisle_, {}) {
    for (int k = 0; k < 6; ++k) {
      truth_.push_back({exp_so3({0, 0, 0.02 * k}), {0.08 * k, 0.01 * k, 0}});
    }
  }

  /// Keyframe k at frame 30 k, with the tag in view of the first and the last, and `second`
  /// in view of the last two.
  std::shared_ptr<const FrameFeatures> keyframe(int k, bool second) const {
    const auto i = static_cast<std::size_t>(k);
    const bool sees = k == 0 || k == 5;
    auto features = std::make_shared<FrameFeatures>(
        *(sees ? aisle_.frame_with_tag(30 * k, truth_[i], T_world_tag_)
               : aisle_.frame(30 * k, truth_[i])));
    if (second && k >= 4) {
      TagSighting other = sighting(1, truth_[i].inverse() * truth_[4] * T_body_tag_);
      features->tags.insert(features->tags.begin(), with_corners(other));
    }
    return features;
  }

  /// Every keyframe drifts by 1 cm and 0.3 degrees more than the previous one.
  Pose drifted(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return truth_[i] * Pose{exp_so3({0, 0, 0.005 * k}), {0.01 * k, 0, 0}};
  }

  LoopClosure drive_and_close(LoopCloser& loop, bool second, bool adjusts = true) {
    for (int k = 0; k < 6; ++k) {
      const auto features = keyframe(k, second);
      EXPECT_EQ(loop.sees_loop(*features, 0.5 * k), k == 5) << k;
      const int id = known_.add(features, drifted(k));
      if (k == 5) return loop.close(id, 0.5 * k, known_.rig, known_.map, adjusts);
      loop.record(*features, drifted(k), 0.5 * k, known_.map);
    }
    return {};
  }

  void expect_true_poses() const {
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(test::distance(known_.map.keyframes()[k].T_map_body, truth_[k]), 1e-5) << k;
      EXPECT_LT(test::angle(known_.map.keyframes()[k].T_map_body, truth_[k]), 1e-5) << k;
    }
  }

  const Pose T_world_tag_ = Pose{exp_so3({-1.5, 0.1, 0}), {0.25, -0.8, 0.5}};
  std::vector<Pose> truth_;
  test::AisleMap known_;
};

}  // namespace vinebench::slam::test_case
