// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/pose.h"
#include "core/truth/truth_images.h"

namespace vinebench {

/// What only the judge may know of an instant.
struct Truth {
  Pose T_world_body;
  bool known = true;  ///< false where a recording has no ground truth; the pose means nothing then
  std::vector<double> box_share;  ///< of each camera's pixels, 0 to 1, those that show a carton box
  /// Indices into the list of the world's tags (Site::tags) that are wholly in the image of a tag
  /// camera, unoccluded at their centre and corners.
  std::vector<int> visible_tags;
  /// Of each camera's image, s, the time over which motion blurs it; empty where not known.
  std::vector<double> blur_time{};
  /// Of each camera the truth images that a CapturePlan asks for, without colours, with the true
  /// camera and its place; their motion is the wind's, to the next frame of the plan. Empty where
  /// no plan asks for any.
  std::vector<TruthView> views;
};

/// Something wrong with the data of a frame that its source survived, such as an image that cannot
/// be read.
struct SourceEvent {
  std::string event;   ///< its kind, for counting: "picture_missing"
  std::string sensor;  ///< name of the camera or other sensor
  std::string detail;  ///< what was found, for people
};

/// One tick of a source of frames. Only `frame` is passed on to a SLAM system.
struct Sample {
  Frame frame;
  Truth truth;
  std::vector<SourceEvent> events;
};

}  // namespace vinebench
