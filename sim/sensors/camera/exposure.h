// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"
#include "sim/sensors/effects/shot.h"

namespace vinebench::sim {

/// s, about what a vineyard at midday needs with the default reference time.
inline constexpr double kNominalTime = 0.002;

/// How long an image is exposed and how much its signal is amplified. A white wall in the scene's
/// nominal light is white in what `reference_time` at 0 dB makes of it; a vineyard is darker.
struct ExposureConfig {
  std::optional<double> time;       ///< s, of the first image; metered on it where absent
  double gain_db = 0;               ///< dB, beside what is metered; 20 dB are ten times the signal
  double reference_time = 0.00065;  ///< s
  bool automatic = false;           ///< set by the brightness of earlier frames
  double target = 110;              ///< grey levels, mean brightness that is metered and steered to
  double time_constant = 0.3;       ///< s, in which it makes up for most (1 - 1/e) of an error
  double min_time = 0.00002;        ///< s
  double max_time = 0.016;          ///< s; beyond it the gain grows
  double max_gain_db = 24;          ///< dB
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
  bool metered() const { return !time; }
  /// The longest that this configuration ever exposes, s.
  double longest() const { return automatic || metered() ? max_time : *time; }
};

/// Sets exposure and gain of each camera of a rig from the images that it delivered before. The
/// two cameras of a stereo pair share theirs.
class ExposureControl {
 public:
  ExposureControl(const ExposureConfig& config, const Rig& rig);

  /// Of that camera's next image.
  const Exposure& of(std::size_t camera) const { return groups_[group_of_[camera]].exposure; }

  /// Takes an image of a camera with the exposure of().
  using Take = std::function<cv::Mat(std::size_t camera)>;

  /// Before the first image, where no time is given: exposes one camera of each group for the
  /// target, in kLooks looks, then raises the gain by the configured one.
  void meter(const Take& take);

  /// Takes in the images of a frame, one a camera; empty ones were not delivered. The mean of a
  /// group's brightness moves the logarithm of its exposure towards the target's by a first-order
  /// lag: time is lengthened first, then the gain raised.
  void observe(const std::vector<cv::Mat>& images);

 private:
  struct Group {
    std::vector<std::size_t> cameras;
    Exposure exposure;
  };
  void steer(Group& group, double brightness, double step) const;

  ExposureConfig config_;
  double step_;  ///< share of an error that one frame makes up for
  std::vector<Group> groups_;
  std::vector<std::size_t> group_of_;
};

/// Looks that settle a metered exposure: each corrects what was burnt out or black before.
inline constexpr int kLooks = 3;

/// The exposure, as a factor on all light, that is metered with the defaults on what `draw` draws
/// with one.
double metered_factor(const std::function<cv::Mat(double factor)>& draw);

/// Mean of an image's codes (CV_8U, any channels), over every fourth row.
double mean_brightness(const cv::Mat& image);

}  // namespace vinebench::sim
