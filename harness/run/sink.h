// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/slam_system.h"
#include "core/truth/frame_source.h"

namespace vinebench::harness {

/// Receives the ticks of a run.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void on_tick(const Sample& sample, const Estimate& estimate) = 0;
  virtual void on_finish(const SlamSummary&) {}
};

}  // namespace vinebench::harness
