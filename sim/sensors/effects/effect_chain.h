// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// Effects in the order in which they are added, stage by stage: views, light, codes.
class EffectChain {
 public:
  /// Null is an effect that is off, which is left out.
  void add(std::unique_ptr<ViewEffect> effect);
  void add(std::unique_ptr<LightEffect> effect);
  void add(std::unique_ptr<CodeEffect> effect);

  bool wants_labels(const DrawnView& view) const;
  void apply_to_view(RenderedImage& image, const DrawnView& view) const;

  /// The whole image's colours, as codes (CV_8UC3) or linear light (CV_32FC3), to the codes that
  /// the camera delivers. Codes that no effect changes stay as they are.
  void develop(cv::Mat& image, const Shot& shot);

 private:
  bool changes_light(Stamp instant) const;

  std::vector<std::unique_ptr<ViewEffect>> view_effects_;
  std::vector<std::unique_ptr<LightEffect>> light_effects_;
  std::vector<std::unique_ptr<CodeEffect>> code_effects_;
};

}  // namespace vinebench::sim
