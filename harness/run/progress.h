// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>

#include "harness/run/sink.h"

namespace vinebench::harness {

/// Displays the progress of a run: one updating line on a terminal, plain lines (one every 5 %)
/// elsewhere.
class Progress : public Sink {
 public:
  /// Appends the text of `note` to each line, or the tracking status if there is none.
  Progress(std::ostream& out, bool terminal, std::string title, std::int64_t total,
           std::function<std::string()> note = {});
  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;

 private:
  using Clock = std::chrono::steady_clock;
  std::string line(const Estimate& estimate) const;
  double seconds_per_frame() const;

  std::ostream& out_;
  bool terminal_;
  std::string title_;
  std::int64_t total_;
  std::function<std::string()> note_;
  std::int64_t done_ = 0;
  std::int64_t next_percent_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace vinebench::harness
