// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "slam/features/orb_extractor.h"
#include "slam/loop/loop_config.h"
#include "slam/mapping/mapping_config.h"
#include "slam/odometry/dead_reckoning.h"
#include "slam/patches/refinement_config.h"
#include "slam/stereo/stereo_matcher.h"
#include "slam/tags/tag_detector.h"
#include "slam/tracking/keyframe_config.h"
#include "slam/tracking/tracking_config.h"

namespace vinebench::slam {

/// All settings of the SLAM core; each stage is given its own part.
struct SlamConfig {
  /// Names of the stereo pairs and tag cameras in use; all of the rig where empty.
  std::vector<std::string> cameras;
  OrbConfig features;
  StereoConfig stereo;
  TrackingConfig tracking;
  RefinementConfig refinement;
  KeyframeConfig keyframes;
  MappingConfig mapping;
  DeadReckoningConfig dead_reckoning;
  TagDetectorConfig tags;
  LoopConfig loop;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("cameras", cameras);
    archive("features", features);
    archive("stereo", stereo);
    archive("tracking", tracking);
    archive("refinement", refinement);
    archive("keyframes", keyframes);
    archive("mapping", mapping);
    archive("dead_reckoning", dead_reckoning);
    archive("tags", tags);
    archive("loop", loop);
  }
};

}  // namespace vinebench::slam
