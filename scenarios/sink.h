// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/simulation.h"
#include "slam/base/slam_system.h"

namespace vinebench {

/// Takes what comes out of a run, tick by tick, and changes nothing of it.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void on_tick(const Sample& sample, const Estimate& estimate) = 0;
  virtual void on_finish(const SlamSummary&) {}
};

}  // namespace vinebench
