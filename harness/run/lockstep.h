// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "harness/run/sink.h"

namespace vinebench::harness {

/// The loop of the test bench: each frame of the source goes to the SLAM system, and what it
/// answers goes with the truth to the sinks. The SLAM system is given the frame alone.
/// Asks `stopped` before every tick and ends early when it says so. Returns what the system knows
/// in the end.
SlamSummary run_lockstep(FrameSource& source, SlamSystem& slam, const std::vector<Sink*>& sinks,
                         const std::function<bool()>& stopped = {});

}  // namespace vinebench::harness
