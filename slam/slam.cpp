// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/slam.h"

#include "slam/front_end.h"
#include "slam/pipeline.h"

namespace vinebench {
namespace {

/// Pictures to features to poses, in lockstep.
class MulticameraSlam : public SlamSystem {
 public:
  MulticameraSlam(const SlamConfig& config, const StereoRig& rig,
                  const std::vector<RegisteredTag>& tags, WorkerPool& pool)
      : front_end_(config, rig, tags, pool), pipeline_(config, rig, tags) {}

  Estimate process(const Frame& frame) override {
    return pipeline_.process(front_end_.process(frame, pipeline_.times()));
  }
  SlamSummary finish() override { return pipeline_.finish(); }
  const StageTimes& times() const override { return pipeline_.times(); }

 private:
  FrontEnd front_end_;
  Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<SlamSystem> make_slam(const SlamConfig& config, const Rig& rig,
                                      std::vector<RegisteredTag> tags, WorkerPool& pool) {
  validate(config);
  return std::make_unique<MulticameraSlam>(config, make_stereo_rig(rig, config.cameras), tags,
                                           pool);
}

}  // namespace vinebench
