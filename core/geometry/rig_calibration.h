// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry/pair_calibration.h"

namespace vinebench {

/// By what a rig differs from its file and from what its stamps say.
struct RigCalibration {
  std::vector<PairCalibration> pairs;  ///< those in use, in the rig's order
  /// s that images are taken later than they are stamped: of each camera in use for tags, in the
  /// rig's order.
  std::vector<double> tag_times;

  bool empty() const { return pairs.empty(); }
};

}  // namespace vinebench
