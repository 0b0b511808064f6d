// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/fakes.h"

namespace vinebench::test {

using harness::RunRecord;
using harness::Tick;
using harness::Trial;

/// Twenty seconds straight east at 0.5 m/s, 10 frames a second, with a pair and a side camera in
/// clear view and a tag in view from 5 s to 6 s. No degradation.
class SteadyDrive : public testing::Test {
 protected:
  SteadyDrive() {
    record_.rig = test::fake_rig();
    record_.rig.stereo_pairs = {{"front", 0, 1}};
    for (RigCamera& camera : record_.rig.cameras) camera.model.fx = 300;
    record_.tags = trial_.site.tags;
    for (std::int64_t i = 0; i <= 200; ++i) {
      Tick tick;
      tick.index = i;
      tick.stamp = stamp_of_frame(i, 10);
      tick.truth.T_world_body.translation.x() = 0.05 * static_cast<double>(i);
      tick.truth.occlusion.resize(3);
      tick.truth.blur_time = {0, 0, 0};
      tick.delivered = {true, true, true};
      tick.estimate.status = TrackingStatus::kTracking;
      tick.estimate.T_map_body = tick.truth.T_world_body;
      tick.estimate.cameras = {{500, 200, 100, 90}, {200, 0, 90, 90}, {}};
      if (i >= 50 && i <= 60) {
        tick.truth.visible_tags = {0};
        TagSighting sighting;
        sighting.family = record_.tags[0].family;
        sighting.id = record_.tags[0].id;
        tick.estimate.tags.push_back(sighting);
      }
      record_.ticks.push_back(tick);
    }
  }

  /// Changes the ticks from 10 s to 12 s, both included: 100 to 120.
  void meanwhile(const std::function<void(Tick&)>& change) {
    for (std::size_t i = 100; i <= 120; ++i) change(record_.ticks[i]);
  }
  /// From 10 s on the estimate drifts to the left, up to 0.1 m at 12 s.
  void slide() {
    for (std::size_t i = 100; i < record_.ticks.size(); ++i) {
      const double share = std::min(1.0, static_cast<double>(i - 100) / 20);
      record_.ticks[i].estimate.T_map_body->translation.y() = 0.1 * share;
    }
  }

  Trial trial_ = test::fake_trial();
  RunRecord record_;
};

/// Below a third of the usual inliers.
inline void weaken(Tick& tick) {
  tick.estimate.cameras[0].inliers = tick.estimate.cameras[1].inliers = 10;
}

}  // namespace vinebench::test
