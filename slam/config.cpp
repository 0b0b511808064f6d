// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/config.h"

namespace vinebench::slam {

void paper_settings(SlamConfig& config) {
  constexpr double kNever = 1e9;  // m, degrees
  config.stereo.search = StereoSearch::kFeatures;
  config.stereo.few = 0;  // 40 baselines are the limit everywhere
  config.stereo.self_calibration = false;
  config.refinement.enabled = false;
  config.keyframes.distance = kNever;
  config.keyframes.angle_deg = kNever;
  config.tracking.min_inlier_share = 0;  // cameras are not judged one by one
  config.loss = ResidualLoss::kHuber;
}

bool has_paper_setting(const SlamConfig& config) {
  SlamConfig paper = config;
  paper_settings(paper);
  return config.stereo.search == paper.stereo.search || config.stereo.few == paper.stereo.few ||
         config.stereo.self_calibration == paper.stereo.self_calibration ||
         config.refinement.enabled == paper.refinement.enabled ||
         config.keyframes.distance == paper.keyframes.distance ||
         config.keyframes.angle_deg == paper.keyframes.angle_deg ||
         config.tracking.min_inlier_share == paper.tracking.min_inlier_share ||
         config.loss == paper.loss;
}

}  // namespace vinebench::slam
