// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"
#include "core/time.h"
#include "sim/render/renderer.h"
#include "sim/sensors/camera/bayer.h"
#include "sim/sensors/camera/exposure.h"
#include "sim/sensors/camera/fixed_pattern.h"
#include "sim/sensors/camera/lens.h"
#include "sim/sensors/camera/lens_dirt.h"
#include "sim/sensors/camera/photon_transfer.h"
#include "sim/sensors/camera/vignette.h"

namespace vinebench::sim {

/// How the cameras make images of what is before them. Only the noise is on by default.
struct CameraSensorConfig {
  ExposureConfig exposure;
  PhotonTransferConfig noise;
  FixedPatternConfig fixed_pattern;
  double gamma = 2.2;  ///< code / 255 = signal^(1 / gamma); 1 is linear
  VignettingConfig vignetting;
  int blur_subframes = 1;   ///< instants that an exposure is the mean of; 1 draws no blur
  double readout_time = 0;  ///< s from the first row's exposure to the last's; 0: all at once
  int readout_bands = 16;   ///< bands of rows, each drawn as of one instant
  BayerPattern bayer = BayerPattern::kNone;
  std::vector<LensDirtConfig> dirt;
  std::vector<LensLeafConfig> leaves;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("exposure", exposure);
    archive("noise", noise);
    archive("fixed_pattern", fixed_pattern);
    archive("gamma", gamma, Range::between(0.2, 5));
    archive("vignetting", vignetting);
    archive("blur_subframes", blur_subframes, Range::between(1, 256));
    archive("readout_time", readout_time, Range::between(0, 0.2));
    archive("readout_bands", readout_bands, Range::between(2, 4096));
    archive("bayer", bayer);
    archive("dirt", dirt);
    archive("leaves", leaves);
  }
  /// How long before and after its instant an image can be exposed at most, s.
  double half_window() const {
    return 0.5 * readout_time + (blur_subframes > 1 ? 0.5 * exposure.longest() : 0);
  }
};

/// One camera: from the scene to the image that it delivers.
///
/// In the order of the light's way: the scene is drawn at the instants of the sub-frames and bands
/// of rows, with the exposure's factor; averaged as linear light; bent by the lens; covered by what
/// sticks to the glass; dimmed towards the corners; and then, per pixel of the sensor, given its
/// fixed pattern, filtered for colour, amplified with noise, saturated, encoded to 8 bits and
/// interpolated to full colour. An effect that is off costs nothing, and with all of them off the
/// image is the renderer's to the byte.
class CameraSensor {
 public:
  /// `camera` is the true one, the `index`-th of the rig.
  CameraSensor(const CameraSensorConfig& config, const RigCamera& camera, int index,
               std::uint64_t seed);

  struct Shot {
    std::int64_t frame = 0;
    Stamp instant = 0;  ///< the middle of the middle row's exposure
    Exposure exposure;
    Renderer::Request request;  ///< beside the colours; exposure, time and rover are set here
  };
  /// The body's pose at an instant within half_window() of the shot's.
  using PoseAt = std::function<Pose(Stamp)>;
  using Render = std::function<RenderedImage(const PinholeCamera&, const Pose& T_world_cam,
                                             const Renderer::Request&)>;

  /// All but the colours is that of the middle sub-frame, through the same lens.
  RenderedImage capture(const Shot& shot, const PoseAt& T_world_body, const Render& render);

  /// When that sub-frame of the middle row is: of an even number the one after the middle.
  Stamp truth_instant(const Shot& shot) const;

 private:
  RenderedImage expose(const Shot& shot, const PoseAt& T_world_body, const Render& render) const;
  RenderedImage expose_band(std::size_t band, const Shot& shot, const PoseAt& T_world_body,
                            const Render& render) const;
  Stamp readout_delay(const LensBand& band) const;
  void develop(cv::Mat& image, const Shot& shot);
  void dim_and_cover(cv::Mat& light, const Shot& shot) const;
  bool changes_light(Stamp instant) const;

  CameraSensorConfig config_;
  RigCamera camera_;
  int index_;
  std::uint64_t seed_;
  std::vector<LensBand> bands_;
  std::vector<LensCover> covers_;
  cv::Mat vignette_;  ///< empty where off
  std::optional<FixedPattern> fixed_pattern_;
  PhotonTransfer photon_transfer_;
};

}  // namespace vinebench::sim
