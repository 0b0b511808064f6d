// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/frame_stream.h"

#include <algorithm>
#include <utility>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

CapturePlan plan_of(const StreamRequest& request, const Rig& rig) {
  if (request.first < 0 || request.last < request.first || request.every < 1) {
    fail("frames: expected 0 <= first <= last, and every >= 1, found {} to {}, {}", request.first,
         request.last, request.every);
  }
  CapturePlan plan = plan_of(static_cast<const FramesRequest&>(request), rig);
  plan.first = request.first;
  plan.last = request.last;
  plan.every = request.every;
  return plan;
}

}  // namespace

FrameStream::FrameStream(const StreamRequest& request)
    : scenario_(scenario_of(request)),
      pool_(std::max(1, request.threads)),
      source_(sim::make_simulation(scenario_.simulation, static_cast<std::uint64_t>(scenario_.seed),
                                   request.machine.plant_cache, pool_,
                                   plan_of(request, load_rig(scenario_.simulation.rover.rig)))) {
  if (source_->size() == 0) fail("frames: the run has no frame from {} on", request.first);
  ahead_.emplace(*source_);
}

std::shared_ptr<const DatasetFrame> FrameStream::next() {
  std::optional<Sample> sample = ahead_->next();
  if (!sample) return nullptr;
  return std::make_shared<const DatasetFrame>(
      DatasetFrame{frames_++, std::move(sample->frame), std::move(sample->truth)});
}

}  // namespace vinebench::harness
