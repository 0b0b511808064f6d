// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "harness/run/sink.h"

namespace vinebench::harness {

/// The loop of the test bench: each frame of the source goes to the SLAM system; the estimate and
/// the truth go to the sinks. The SLAM system gets the frame only. Polls `stopped` before every
/// tick and ends early if it returns true. Returns the system's final result; an empty one after a
/// SystemFailure, which the sinks are told unless `stopped` returns true.
SlamSummary run_lockstep(FrameSource& source, SlamSystem& slam, const std::vector<Sink*>& sinks,
                         const std::function<bool()>& stopped = {});

}  // namespace vinebench::harness
