// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "sim/render/render_engine.h"

namespace vinebench::sim {

/// The camera with `factor` times as many pixels a side, of the same view.
PinholeCamera enlarged(const PinholeCamera& camera, int factor);

/// The mean light of each square of `factor` by `factor` pixels (CV_8UC3), as codes.
cv::Mat mean_of_squares(const cv::Mat& codes, int factor);

/// Draws colours with several samples a pixel, from the same levels of detail, by another engine.
///
/// No sample of an even number lies at the pixel's centre, where truth is exact. So where truth is
/// asked for, it is drawn at the delivered size, and is that of the other engine to the byte.
class SupersampledEngine : public RenderEngine {
 public:
  /// `factor` samples a pixel's side, at least 2.
  SupersampledEngine(std::unique_ptr<RenderEngine> engine, int factor);

  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const RenderRequest& request) override;

 private:
  std::unique_ptr<RenderEngine> engine_;
  int factor_;
};

}  // namespace vinebench::sim
