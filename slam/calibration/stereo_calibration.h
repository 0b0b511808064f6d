// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "slam/optimisation/bundle_adjustment.h"

namespace vinebench::slam {

/// Whether it is time to look at the calibration again: after a dozen keyframes, then each time
/// their number has doubled, a few times.
bool calibration_due(const Map& map);

/// What the pairs' calibration is off by, as the map itself shows it. A camera that looks a little
/// to the side of where the calibration has it measures all disparities wrong by the same number of
/// pixels; then what is near and what is far tell of different scales, which one more unknown a
/// pair in the adjustment of the latest keyframes resolves.
///
/// Disparity offsets of the cameras (px), where one of them differs from the rig's by more than
/// what the images' own errors bring about, the residuals bear it out, both halves of the latest
/// keyframes show it, and none is larger than three times the calibration's accuracy
/// (MeasurementNoise::disparity_offset_sigma); otherwise none. The map is not touched.
std::optional<std::vector<double>> find_disparity_offsets(const Map& map, const EstimatorRig& rig,
                                                          const AdjustmentOptions& options);

}  // namespace vinebench::slam
