// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "core/frame.h"
#include "core/util/stage_timer.h"
#include "core/util/worker_pool.h"
#include "slam/camera/stereo_rig.h"
#include "slam/features/orb_extractor.h"
#include "slam/frame/frame_features.h"
#include "slam/odometry/wheel_odometry.h"
#include "slam/stereo/eye_alignment.h"
#include "slam/stereo/eye_balance.h"
#include "slam/stereo/stereo_matcher.h"
#include "slam/tags/tag_detector.h"

namespace vinebench::slam {

/// What FrontEnd is set by.
struct FrontEndSettings {
  OrbConfig features;
  StereoConfig stereo;
  TagDetectorConfig tags;
  std::optional<MecanumWheels> wheels;
};

/// Boils a frame's images down to features with stereo matches, and tags. Frames are to come in the
/// order of their time: what the eyes of a pair were found to differ in holds for the next one.
class FrontEnd {
 public:
  FrontEnd(const FrontEndSettings& settings, const StereoRig& rig,
           const std::vector<RegisteredTag>& tags, WorkerPool& pool);

  /// Throws Error for an image of the wrong size or type. A missing (empty) image has no
  /// features. Adds the stages "features", "stereo" and "tags", each summed over its images.
  std::shared_ptr<FrameFeatures> process(const Frame& frame, StageTimes& times);

 private:
  cv::Mat grey(const Frame& frame, int camera) const;
  Extraction extract_right(std::size_t pair, double gain) const;
  void extract(const Frame& frame, StageTimes& times);
  void match(FrameFeatures& features, StageTimes& times);
  std::vector<StereoMatch> match_pair(std::size_t pair);

  StereoRig rig_;
  StereoConfig stereo_;
  OrbExtractor extractor_;
  std::optional<WheelOdometry> odometry_;
  std::vector<TagDetector> detectors_;  ///< one for each tag camera
  WorkerPool& pool_;
  std::vector<Extraction> left_;          ///< of each pair
  std::vector<Extraction> right_;         ///< of each pair; without features where none are needed
  std::vector<cv::Mat> right_images_;     ///< of each pair, rectified by the rig file, as taken
  std::vector<EyeBalance> balances_;      ///< of each pair
  std::vector<EyeAlignment> alignments_;  ///< of each pair
  std::vector<std::vector<TagSighting>> sightings_;  ///< of each tag camera
};

}  // namespace vinebench::slam
