// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/geometry/rig.h"
#include "sim/scene/scene.h"
#include "sim/sensors/effects/shot.h"

namespace vinebench::sim {

/// What an effect may know of its camera when it is made.
struct EffectInputs {
  const RigCamera& camera;  ///< the true one
  int index = 0;            ///< of the camera in its rig
  std::uint64_t seed = 0;
  const Light& light;  ///< of the scene

  cv::Size size() const { return {camera.model.width, camera.model.height}; }
};

/// A pinhole's view as the engine drew it: of one sub-frame and band of rows.
struct DrawnView {
  const PinholeCamera& camera;
  const Pose& T_world_cam;
  double exposure = 1;  ///< factor on all light
};

/// An effect on each drawn view, before blur averages and the lens bends them.
class ViewEffect {
 public:
  virtual ~ViewEffect() = default;
  /// Whether apply() needs the labels of that view.
  virtual bool wants_labels(const DrawnView& view) const = 0;
  /// Onto the engine's codes, in place.
  virtual void apply(RenderedImage& image, const DrawnView& view) const = 0;
};

/// An effect on the whole image as light.
class LightEffect {
 public:
  virtual ~LightEffect() = default;
  /// Whether it changes an image of that instant; the others need not become light.
  virtual bool is_active(Stamp) const { return true; }
  /// Onto linear light (CV_32FC3, 1 is white), in place.
  virtual void apply(cv::Mat& light, const Shot& shot) const = 0;
};

/// An effect on the pixels' codes.
class CodeEffect {
 public:
  virtual ~CodeEffect() = default;
  /// Onto 8-bit codes: CV_8UC3 RGB, or CV_8UC1 between colour filters and interpolation.
  virtual void apply(cv::Mat& codes, const Shot& shot) = 0;
};

}  // namespace vinebench::sim
