// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"
#include "core/time.h"
#include "sim/render/render_engine.h"
#include "sim/sensors/camera/depth_of_field.h"
#include "sim/sensors/camera/exposure.h"
#include "sim/sensors/camera/lens.h"
#include "sim/sensors/camera/point_spread.h"
#include "sim/sensors/effects/effect_list.h"

namespace vinebench::sim {

/// How the cameras make images of what is before them. Only the lens' point spread and the noise
/// are on by default.
struct CameraSensorConfig : EffectsConfig {
  ExposureConfig exposure;
  int blur_subframes = 1;   ///< instants that an exposure is the mean of; 1 draws no blur
  double readout_time = 0;  ///< s from the first row's exposure to the last's; 0: all at once
  int readout_bands = 16;   ///< bands of rows, each drawn as of one instant
  DepthOfFieldConfig depth_of_field;
  double point_spread = 0.5;  ///< px, standard deviation of a point's image by the lens
  template <class Archive>
  void serialize(Archive& archive) {
    archive("exposure", exposure);
    archive("blur_subframes", blur_subframes, Range::between(1, 256));
    archive("readout_time", readout_time, Range::between(0, 0.2));
    archive("readout_bands", readout_bands, Range::between(2, 4096));
    archive("depth_of_field", depth_of_field);
    archive("point_spread", point_spread, Range::between(0, kWidestPointSpread));
    EffectsConfig::serialize(archive);
  }
  /// How long before and after its instant an image can be exposed at most, s.
  double half_window() const {
    return 0.5 * readout_time + (blur_subframes > 1 ? 0.5 * exposure.longest() : 0);
  }
};

/// One camera: from the scene to the image that it delivers.
///
/// The scene is drawn at the instants of the sub-frames and bands of rows, with the exposure's
/// factor, and blurred where the lens is not focused; averaged as linear light; bent and spread by
/// the lens. The effects of effect_list.cpp work on the views before that and on the light and the
/// codes after it. An effect that is off costs nothing, and with all of them off the image is the
/// engine's to the byte.
class CameraSensor {
 public:
  /// `camera` is the true one, the `index`-th of the rig; `light` is the scene's.
  CameraSensor(const CameraSensorConfig& config, const RigCamera& camera, int index,
               std::uint64_t seed, const Light& light);

  /// The body's pose at an instant within half_window() of the shot's.
  using PoseAt = std::function<Pose(Stamp)>;
  using Render = std::function<RenderedImage(const PinholeCamera&, const Pose& T_world_cam,
                                             const RenderRequest&)>;

  /// All but the colours is that of the middle sub-frame, through the same lens.
  RenderedImage capture(const Shot& shot, const PoseAt& T_world_body, const Render& render);

  /// When that sub-frame of the middle row is: of an even number the one after the middle.
  Stamp truth_instant(const Shot& shot) const;

 private:
  RenderedImage expose(const Shot& shot, const PoseAt& T_world_body, const Render& render) const;
  RenderedImage expose_band(std::size_t band, const Shot& shot, const PoseAt& T_world_body,
                            const Render& render) const;
  RenderedImage draw(const LensBand& band, const Pose& T_world_rover, const RenderRequest& request,
                     const Render& render) const;
  Stamp readout_delay(const LensBand& band) const;

  CameraSensorConfig config_;
  RigCamera camera_;
  std::vector<LensBand> bands_;
  EffectChain effects_;
};

}  // namespace vinebench::sim
