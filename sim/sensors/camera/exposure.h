// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"
#include "sim/sensors/effects/shot.h"

namespace vinebench::sim {

/// How long an image is exposed and how much its signal is amplified. The scene as it is rendered
/// is what `reference_time` at 0 dB makes of it.
struct ExposureConfig {
  double time = 0.002;            ///< s; with `automatic`, of the first image
  double gain_db = 0;             ///< dB; 20 dB are ten times the signal
  double reference_time = 0.002;  ///< s
  bool automatic = false;
  double target = 110;         ///< grey levels, mean brightness that `automatic` steers to
  double time_constant = 0.3;  ///< s, in which it makes up for most (1 - 1/e) of an error
  double min_time = 0.00002;   ///< s
  double max_time = 0.016;     ///< s; beyond it the gain grows
  double max_gain_db = 24;     ///< dB
  template <class Archive>
  void serialize(Archive& archive) {
    archive("time", time, Range{0, 0.2, true});
    archive("gain_db", gain_db, Range::between(-20, 60));
    archive("reference_time", reference_time, Range{0, 10, true});
    archive("automatic", automatic);
    archive("target", target, Range::between(5, 250));
    archive("time_constant", time_constant, Range::between(0, 1000));
    archive("min_time", min_time, Range{0, 0.2, true});
    archive("max_time", max_time, Range{0, 0.2, true});
    archive("max_gain_db", max_gain_db, Range::between(0, 60));
    archive.require(min_time <= max_time, "max_time", "expected at least min_time");
  }
  /// The longest that this configuration ever exposes, s.
  double longest() const { return automatic ? max_time : time; }
};

/// Sets exposure and gain of each camera of a rig from the images that it delivered before. The
/// two cameras of a stereo pair share theirs.
class ExposureControl {
 public:
  ExposureControl(const ExposureConfig& config, const Rig& rig);

  /// Of that camera's next image.
  const Exposure& of(std::size_t camera) const { return groups_[group_of_[camera]].exposure; }

  /// Takes in the images of a frame, one a camera; empty ones were not delivered. The mean of a
  /// group's brightness moves the logarithm of its exposure towards the target's by a first-order
  /// lag: time is lengthened first, then the gain raised.
  void observe(const std::vector<cv::Mat>& images);

 private:
  struct Group {
    std::vector<std::size_t> cameras;
    Exposure exposure;
  };
  void steer(Group& group, double brightness) const;

  ExposureConfig config_;
  double step_;  ///< share of an error that one frame makes up for
  std::vector<Group> groups_;
  std::vector<std::size_t> group_of_;
};

/// Mean of an image's codes (CV_8U, any channels), over every fourth row.
double mean_brightness(const cv::Mat& image);

}  // namespace vinebench::sim
