// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "slam/calibration/calibration_config.h"
#include "slam/camera/measurement_noise.h"
#include "slam/features/orb_extractor.h"
#include "slam/loop/loop_config.h"
#include "slam/loop/places_config.h"
#include "slam/mapping/mapping_config.h"
#include "slam/odometry/dead_reckoning.h"
#include "slam/patches/refinement_config.h"
#include "slam/stereo/stereo_matcher.h"
#include "slam/tags/tag_detector.h"
#include "slam/tracking/keyframe_config.h"
#include "slam/tracking/tracking_config.h"

namespace vinebench::slam {

/// What the other settings are where a file does not give them.
enum class Preset {
  kDefault,
  kPaper,  ///< the paper's core as published, as far as its text says: paper_settings()
};
inline std::vector<std::string> yaml_names(Preset) {
  return {"default", "paper"};
}

struct SlamConfig;

/// Sect. III of the paper: features at FAST's pixels without patches, stereo matches between
/// features, Huber's loss, keyframes by the number of tracked landmarks, no calibration by the
/// core. What the text leaves open (thresholds, losses of track, wheels while blind, a tag's
/// corners in place of its pose in the global adjustment) is as in the default.
void paper_settings(SlamConfig& config);

/// Whether any of these settings is left.
bool has_paper_setting(const SlamConfig& config);

/// All settings of the SLAM core; each stage is given its own part.
struct SlamConfig {
  Preset preset = Preset::kDefault;  ///< settings of the paper where the file has none
  /// Names of the stereo pairs and tag cameras in use; all of the rig where empty.
  std::vector<std::string> cameras;
  OrbConfig features;
  StereoConfig stereo;
  CalibrationConfig calibration;
  TrackingConfig tracking;
  RefinementConfig refinement;
  KeyframeConfig keyframes;
  MappingConfig mapping;
  DeadReckoningConfig dead_reckoning;
  std::optional<InertialConfig> inertial;   ///< where an inertial unit takes part
  std::optional<WheelFusionConfig> wheels;  ///< where the wheels take part beside it
  TagDetectorConfig tags;
  LoopConfig loop;
  std::optional<PlacesConfig> places;         ///< where places close loops too, by their looks
  ResidualLoss loss = ResidualLoss::kCauchy;  ///< of reprojection errors in adjustments

  template <class Archive>
  void serialize(Archive& archive) {
    archive("preset", preset);
    if constexpr (requires { Archive::kReads; }) {
      if (preset == Preset::kPaper) paper_settings(*this);
    }
    archive("cameras", cameras);
    archive("features", features);
    archive("stereo", stereo);
    archive("calibration", calibration);
    archive("tracking", tracking);
    archive("refinement", refinement);
    archive("keyframes", keyframes);
    archive("mapping", mapping);
    archive("dead_reckoning", dead_reckoning);
    archive("inertial", inertial);
    archive("wheels", wheels);
    archive("tags", tags);
    archive("loop", loop);
    archive("places", places);
    archive("loss", loss);
    archive.require(!wheels || inertial, "wheels",
                    "expected an inertial unit beside them (inertial: {})");
    archive.require(preset == Preset::kDefault || has_paper_setting(*this), "preset",
                    "expected some of the keys that it sets to be left to it; all are given, as in "
                    "settings that a run has written out");
  }
};

}  // namespace vinebench::slam
