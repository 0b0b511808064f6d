// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/pose.h"
#include "core/trajectory.h"
#include "core/truth/occlusion.h"
#include "core/truth/truth_images.h"

namespace vinebench {

/// How a camera's image was taken, beside the exposure time.
struct Capture {
  double gain_db = 0;       ///< dB
  double readout_time = 0;  ///< s, from the first row's exposure to the last's
  double stamp_error = 0;   ///< s, that the frame's stamp is after the middle of the exposure
};

/// What an inertial reading has besides truth and noise, in the body frame.
struct ImuBias {
  Stamp stamp = 0;                                             ///< of the reading
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();    ///< m/s^2
};

/// The ground truth of an instant, for the evaluation only.
struct Truth {
  Pose T_world_body;
  bool known = true;  ///< false if a recording has no ground truth; the pose is then undefined
  /// Of each camera's image, the shares covered by occluders; empty if unknown.
  std::vector<Occlusion> occlusion{};
  /// True poses at the instants of the inertial readings since the previous frame, and that of the
  /// start, oldest first; empty if unknown.
  Trajectory path{};
  /// Of the frame's inertial readings, in their order; empty if unknown.
  std::vector<ImuBias> imu_biases{};
  /// Indices into the list of the world's tags (Site::tags) that are completely in the image of a
  /// tag camera, unoccluded at their centre and corners.
  std::vector<int> visible_tags;
  /// Of each camera, s, the exposure time that causes motion blur; empty if unknown.
  std::vector<double> blur_time{};
  /// Of each camera; empty if unknown.
  std::vector<Capture> captures{};
  /// Of each camera, the truth images that a CapturePlan requests, without colours, with the true
  /// camera and its pose; their motion is the wind's, to the next frame of the plan. Empty if no
  /// plan requests any.
  std::vector<TruthView> views;
};

/// A fault in the data of a frame that did not stop its source, such as an unreadable image.
struct SourceEvent {
  std::string event;   ///< its kind, for counting: "picture_missing"
  std::string sensor;  ///< name of the camera or other sensor
  std::string detail;  ///< human-readable
};

/// One tick of a source of frames. Only `frame` is passed on to a SLAM system.
struct Sample {
  Frame frame;
  Truth truth;
  std::vector<SourceEvent> events;
};

}  // namespace vinebench
