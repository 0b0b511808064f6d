// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/slam.h"

#include "core/config/validate.h"
#include "slam/front_end.h"
#include "slam/map/map_file.h"
#include "slam/map/point_cloud.h"
#include "slam/pipeline.h"

namespace vinebench::slam {
namespace {

/// Images to features to poses, in lockstep.
class MulticameraSlam : public MappingSystem {
 public:
  MulticameraSlam(const SlamConfig& config, const StereoRig& rig,
                  const std::vector<RegisteredTag>& tags, WorkerPool& pool)
      : front_end_({config.features, config.stereo, config.tags, config.dead_reckoning.wheels}, rig,
                   tags, pool),
        pipeline_(config, rig, tags, pool.threads() == 1),
        min_observations_(config.mapping.min_observations) {}

  Estimate process(const Frame& frame) override {
    return pipeline_.process(front_end_.process(frame, pipeline_.times()));
  }
  SlamSummary finish() override { return pipeline_.finish(); }
  const StageTimes& times() const override { return pipeline_.times(); }

  void load_map(const std::filesystem::path& file) override {
    pipeline_.continue_from(slam::load_map(file, pipeline_.rig()));
  }
  void save_map(const std::filesystem::path& file) const override {
    slam::save_map(pipeline_.map(), pipeline_.rig(), file);
  }
  void save_cloud(const std::filesystem::path& file) const override {
    save_point_cloud(pipeline_.map(), min_observations_, file);
  }
  std::vector<SupportingFeature> supporting_features() const override {
    return pipeline_.supporting_features();
  }

 private:
  FrontEnd front_end_;
  Pipeline pipeline_;
  int min_observations_;
};

}  // namespace

std::unique_ptr<MappingSystem> make_slam(const SlamConfig& config, const Rig& rig,
                                         std::vector<RegisteredTag> tags, WorkerPool& pool) {
  validate(config);
  return std::make_unique<MulticameraSlam>(config, make_stereo_rig(rig, config.cameras), tags,
                                           pool);
}

}  // namespace vinebench::slam
