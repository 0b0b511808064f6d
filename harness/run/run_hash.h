// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "harness/run/sink.h"

namespace vinebench::harness {

/// Fingerprint of a run: XXH3, 128 bits, over every image, sensor sample, true pose, estimate and
/// result, in order, without wall-clock times, so that two runs of the same scenario with the same
/// build have the same hash.
class RunHash : public Sink {
 public:
  RunHash();
  ~RunHash() override;

  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;

  /// Results computed from the rest, as text.
  void add(std::string_view text);

  /// Hash of the data added so far, 32 hexadecimal digits.
  std::string digits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vinebench::harness
