// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/slam_system.h"
#include "core/truth/frame_source.h"
#include "harness/run/system_failure.h"

namespace vinebench::harness {

/// Receives the ticks of a run.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void on_tick(const Sample& sample, const Estimate& estimate) = 0;
  /// Before on_finish(), whose summary is empty then.
  virtual void on_failure(const SlamFailure&) {}
  virtual void on_finish(const SlamSummary&) {}
};

}  // namespace vinebench::harness
