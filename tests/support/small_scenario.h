// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "harness/datasets/formats.h"
#include "harness/jobs/record.h"
#include "tests/support/shared_plants.h"
#include "tests/support/test_folder.h"

namespace vinebench::test {

inline constexpr double kFocal = 60;       // px, of the pair
inline constexpr double kBaseline = 0.12;  // m

/// Six frames of a rover that starts between a row of two vines and a tag, with three small
/// cameras; in a separate folder, with its plants.
class SmallScenario : public testing::Test {
 protected:
  SmallScenario() {
    request_.machine.plant_cache = shared_plants();
    folder_.write("rig.yaml", R"(name: small
rate_hz: 15
cameras:
  - {name: left, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: right, width: 96, height: 64, fx: 60, fy: 60, position: [0.27, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: side, width: 160, height: 96, fx: 80, fy: 80, position: [0, -0.15, 0.5], rpy_deg: [0, 0, -90]}
stereo_pairs:
  - {name: front, left: left, right: right}
tag_cameras: [side]
)");
    const std::string models = std::string(VINEBENCH_SOURCE_DIR) + "/models/csl-rover";
    request_.scenario = folder_.write("small.yaml", R"(name: small
world:
  name: short row
  rows: [{start: [-0.5, 1.2], end: [2.5, 1.2]}]
  vines: {templates: 1}
  tags: [{family: tag36h11, id: 3, size: 0.3, position: [0.2, -0.9, 0.5], facing_deg: 90}]
rover: {model: )" + models + R"(/rover.xml, rig: rig.yaml}
route:
  acceleration: 2
  waypoints: [{position: [0, 0]}, {position: [1, 0]}]
duration: 0.34
)");
    request_.out = folder_ / "data";
    request_.options.threads = 2;
  }

  harness::RecordOutcome record(const std::vector<std::string>& formats,
                                std::int64_t stop_after = -1) {
    request_.options.formats = harness::parse_formats(formats);
    harness::RecordWatch watch;
    std::int64_t asked = 0;
    if (stop_after >= 0) watch.stopped = [&asked, stop_after] { return asked++ >= stop_after; };
    return harness::record_dataset(request_, watch);
  }

  TestFolder folder_;
  harness::RecordRequest request_;
};

}  // namespace vinebench::test
