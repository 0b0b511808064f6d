// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/prefetch.h"

namespace vinebench::harness {

Prefetch::Prefetch(FrameSource& source) : source_(source) {
  begin();
}

void Prefetch::begin() {
  coming_ = std::async(std::launch::async, [this] { return source_.next(); });
}

std::optional<Sample> Prefetch::next() {
  if (!coming_.valid()) return std::nullopt;
  std::optional<Sample> sample = coming_.get();
  if (sample) begin();
  return sample;
}

const StageTimes& Prefetch::times() const {
  if (coming_.valid()) coming_.wait();
  return source_.times();
}

}  // namespace vinebench::harness
