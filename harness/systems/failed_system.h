// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "core/slam_system.h"
#include "harness/run/system_failure.h"

namespace vinebench::harness {

/// A system that failed while it was made: so says its first frame, and the run has a verdict.
class FailedSystem : public SlamSystem {
 public:
  explicit FailedSystem(SystemFailure failure) : failure_(std::move(failure)) {}
  Estimate process(const Frame&) override { throw SystemFailure(failure_); }
  SlamSummary finish() override { throw SystemFailure(failure_); }
  const StageTimes& times() const override { return times_; }

 private:
  SystemFailure failure_;
  StageTimes times_;
};

}  // namespace vinebench::harness
