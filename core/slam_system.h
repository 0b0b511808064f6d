// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/pose.h"
#include "core/trajectory.h"
#include "core/util/stage_timer.h"

namespace vinebench {

/// A tag whose pose in the world is known beforehand.
struct RegisteredTag {
  std::string family;  ///< e.g. "tag36h11"
  int id = 0;
  double size = 0;   ///< side of the black square, m
  Pose T_world_tag;  ///< tag frame: x right, y down on the printed face, z into the tag
};

enum class TrackingStatus {
  kInitializing,   ///< no map yet, or not yet found in a loaded one
  kTracking,       ///< by cameras
  kDeadReckoning,  ///< the cameras say nothing: by the wheels or the last velocity, ever less sure
  kLost,           ///< no pose
};

/// How well one camera took part in a frame.
struct CameraCounts {
  int features = 0;  ///< extracted
  int stereo = 0;    ///< with a depth within the stereo limit (left cameras only)
  int matches = 0;   ///< with landmarks of the map
  int inliers = 0;   ///< of these, in agreement with the estimated pose
};

/// A tag found in an image of this frame.
struct TagSighting {
  int camera = 0;  ///< index into Rig::cameras
  std::string family;
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners;  ///< px; the tag's own lower left, then counter-clockwise
                                           ///< as printed (AprilTag's order)
  Pose T_cam_tag;
  double corner_sigma = 0;  ///< px, standard deviation of a corner in x or y; 0 where not known
  bool ambiguous = false;   ///< another pose explains the corners nearly as well
};

/// Why a sighting of a tag is not believed.
enum class TagRejection {
  kAmbiguous,  ///< two poses diagnose it
  kMisplaced,  ///< farther from where the map has the tag than the way driven can diagnose
  kDuplicate,  ///< two of this name are in view, in different places
};

/// A sighting that was left out.
struct RejectedTag {
  std::string family;
  int id = 0;
  int camera = 0;  ///< index into Rig::cameras
  TagRejection reason = TagRejection::kAmbiguous;
};

/// A loop closed in this frame: the constraint that tied it to an earlier one.
struct LoopClosure {
  int tag_id = 0;
  Stamp earlier = 0;      ///< stamp of the frame that was recognised
  Stamp later = 0;        ///< stamp of the frame that recognised it
  Pose T_earlier_later;   ///< body to body: by the tag; by way of two, in the adjusted map
  double correction = 0;  ///< how far this frame's body moved, m
};

/// What a SLAM system says of one frame, at that frame.
struct Estimate {
  Stamp stamp = 0;
  TrackingStatus status = TrackingStatus::kInitializing;
  std::optional<Pose> T_map_body;  ///< absent while there is none
  /// Covariance of T_map_body in the body frame (m, then rad: p + R rho, R exp(theta)).
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<CameraCounts> cameras;  ///< in the rig's order
  bool keyframe = false;
  std::vector<TagSighting> tags;           ///< all that were found, the rejected too
  std::vector<RejectedTag> rejected_tags;  ///< of these, while there is a pose to judge them by
  std::optional<LoopClosure> loop_closure;
  /// Of each stereo pair in use, px: found at this frame to be what disparities measure too little,
  /// by an error of the calibration, and made good from here on. Empty where nothing was found.
  std::vector<double> disparity_offsets;
};

/// What a SLAM system knows in the end, after all corrections.
struct SlamSummary {
  Trajectory trajectory;  ///< T_map_body of every frame that has a pose
  Trajectory keyframes;
  std::size_t landmarks = 0;
};

/// A SLAM system as the test bench sees it. It is given frames and nothing else: images, wheel and
/// inertial samples; the rig's calibration and the registered tags came at its construction.
class SlamSystem {
 public:
  virtual ~SlamSystem() = default;

  /// Takes the next frame, in order of the stamps, and answers before it returns.
  virtual Estimate process(const Frame& frame) = 0;

  /// Finishes what is pending and reports.
  virtual SlamSummary finish() = 0;

  /// Wall-clock samples of its stages.
  virtual const StageTimes& times() const = 0;
};

}  // namespace vinebench
