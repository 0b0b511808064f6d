// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/lockstep.h"

namespace vinebench::harness {

SlamSummary run_lockstep(FrameSource& source, SlamSystem& slam, const std::vector<Sink*>& sinks,
                         const std::function<bool()>& stopped) {
  while (!stopped || !stopped()) {
    const std::optional<Sample> sample = source.next();
    if (!sample) break;
    const Estimate estimate = slam.process(sample->frame);
    source.answer(estimate);
    for (Sink* sink : sinks) sink->on_tick(*sample, estimate);
  }
  SlamSummary summary = slam.finish();
  for (Sink* sink : sinks) sink->on_finish(summary);
  return summary;
}

}  // namespace vinebench::harness
