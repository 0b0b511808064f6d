// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/lockstep.h"

namespace vinebench::harness {

SlamSummary run_lockstep(FrameSource& source, SlamSystem& slam, const std::vector<Sink*>& sinks,
                         const std::function<bool()>& stopped) {
  SlamSummary summary;
  std::optional<std::int64_t> frame;
  try {
    while (!stopped || !stopped()) {
      const std::optional<Sample> sample = source.next();
      if (!sample) break;
      frame = sample->frame.index;
      const Estimate estimate = slam.process(sample->frame);
      source.answer(estimate);
      for (Sink* sink : sinks) sink->on_tick(*sample, estimate);
    }
    frame.reset();
    summary = slam.finish();
  } catch (const SystemFailure& failure) {
    const bool by_itself = !stopped || !stopped();
    for (Sink* sink : sinks) {
      if (by_itself) sink->on_failure({failure.what(), frame});
    }
  }
  for (Sink* sink : sinks) sink->on_finish(summary);
  return summary;
}

}  // namespace vinebench::harness
