// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/config.h"

namespace vinebench::slam {

namespace {

/// Calls `visit` with each setting of a configuration that the paper's differs in, and its value
/// there.
template <class Config, class Visit>
void each_paper_setting(Config& config, const Visit& visit) {
  constexpr double kNever = 1e9;  // m, degrees
  visit(config.stereo.search, StereoSearch::kFeatures);
  visit(config.stereo.few, 0);  // 40 baselines are the limit everywhere
  visit(config.stereo.self_calibration, false);
  visit(config.refinement.enabled, false);
  visit(config.keyframes.distance, kNever);
  visit(config.keyframes.angle_deg, kNever);
  visit(config.tracking.min_inlier_share, 0);  // cameras are not judged one by one
  visit(config.loss, ResidualLoss::kHuber);
}

}  // namespace

void paper_settings(SlamConfig& config) {
  each_paper_setting(config, [](auto& setting, const auto& value) { setting = value; });
}

bool has_paper_setting(const SlamConfig& config) {
  bool found = false;
  each_paper_setting(
      config, [&](const auto& setting, const auto& value) { found = found || setting == value; });
  return found;
}

}  // namespace vinebench::slam
