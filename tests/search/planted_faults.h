// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::search_faults {

/// What an estimator could know of a frame.
struct Signs {
  double dark = 0;       ///< share of dark pixels in the left eyes, the largest
  double speed = 0;      ///< m/s, by its own poses
  double turn_rate = 0;  ///< rad/s, likewise
  double gap = 0;        ///< s since the last frame with a stereo image before this one
  double tag_size = 0;   ///< px, side of the smallest tag in view; 0 without one
};
std::vector<Signs> signs_of(const harness::RunRecord& record);

/// A fault of an estimator that shows under certain conditions alone. From each frame on at which
/// they hold, all poses are moved: shifted along the first pose's left, and turned about the frame.
struct PlantedFault {
  std::string name;
  std::string text;  ///< for the table
  std::function<bool(const Signs&)> when;
  double shift = 0;  ///< m, each time that it begins
  double slip = 0;   ///< share of the way driven meanwhile
  double turn = 0;   ///< rad, each time that it begins
};

const std::vector<PlantedFault>& planted_faults();

/// The record of a system with that fault, from that of a sound one.
harness::RunRecord with_fault(harness::RunRecord honest, const PlantedFault& fault);

}  // namespace vinebench::search_faults
