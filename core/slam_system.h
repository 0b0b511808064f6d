// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/pose.h"
#include "core/geometry/rig_calibration.h"
#include "core/trajectory.h"
#include "core/util/stage_timer.h"

namespace vinebench {

/// How well the pose of a tag was surveyed: standard deviations along and about each of its axes,
/// independent of all other tags'. Zero where nobody said.
struct SurveyAccuracy {
  double position = 0;  ///< m
  double rotation = 0;  ///< rad
};

/// A tag whose pose in the world is known in advance.
struct RegisteredTag {
  std::string family;  ///< e.g. "tag36h11"
  int id = 0;
  double size = 0;   ///< side of the black square, m
  Pose T_world_tag;  ///< tag frame: x right, y down on the printed face, z into the tag
  SurveyAccuracy survey{};
};

enum class TrackingStatus {
  kInitializing,   ///< no map yet, or not yet found in a loaded one
  kTracking,       ///< by cameras
  kDeadReckoning,  ///< no camera constraints: by the wheels or the last velocity, with growing
                   ///< covariance
  kLost,           ///< no pose
};

/// Feature counts of one camera in a frame.
struct CameraCounts {
  int features = 0;  ///< extracted
  int stereo = 0;    ///< with a depth within the stereo limit (left cameras only)
  int matches = 0;   ///< to landmarks of the map
  int inliers = 0;   ///< of these, consistent with the estimated pose
};

/// A tag found in an image of this frame.
struct TagSighting {
  int camera = 0;  ///< index into Rig::cameras
  std::string family;
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners;  ///< px; the tag's own lower left, then counter-clockwise
                                           ///< as printed (AprilTag's order)
  Pose T_cam_tag;
  double corner_sigma = 0;  ///< px, standard deviation of a corner in x or y; 0 if unknown
  bool ambiguous = false;   ///< another pose fits the corners nearly as well
  double late = 0;          ///< s, that its image was taken after the frame's stamp
};

/// Why a sighting of a tag was rejected.
enum class TagRejection {
  kAmbiguous,  ///< two poses fit it
  kMisplaced,  ///< farther from the tag's pose in the map than drift can explain
  kDuplicate,  ///< two tags with this number are in view at different positions
};

/// A rejected sighting.
struct RejectedTag {
  std::string family;
  int id = 0;
  int camera = 0;  ///< index into Rig::cameras
  TagRejection reason = TagRejection::kAmbiguous;
};

/// A loop closed in this frame: the constraint to an earlier one.
struct LoopClosure {
  int tag_id = 0;
  Stamp earlier = 0;      ///< stamp of the frame that was recognised
  Stamp later = 0;        ///< stamp of the frame that recognised it
  Pose T_earlier_later;   ///< body to body: measured with the tag; with two tags, from the adjusted
                          ///< map
  double correction = 0;  ///< how far this frame's body moved, m
  /// Covariance of T_earlier_later in the later body's frame (m, then rad), if the system knows it.
  std::optional<Matrix6d> covariance{};
};

/// A feature that supports the pose of a frame.
struct SupportingFeature {
  int camera = 0;         ///< index into Rig::cameras
  Eigen::Vector2d pixel;  ///< in the camera's image
};

/// The live estimate of a SLAM system at one frame.
struct Estimate {
  Stamp stamp = 0;
  TrackingStatus status = TrackingStatus::kInitializing;
  std::optional<Pose> T_map_body;  ///< absent if not initialised or lost
  /// Covariance of T_map_body in the body frame (m, then rad: p + R rho, R exp(theta)).
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<CameraCounts> cameras;  ///< in the rig's order
  bool keyframe = false;
  std::vector<TagSighting> tags;  ///< all detected ones, including the rejected
  std::vector<RejectedTag>
      rejected_tags;  ///< of these; only while there is a pose to gate them with
  std::optional<LoopClosure> loop_closure;
  /// By what the rig's calibration was found to be off at this frame, and corrected from here on.
  /// Empty if nothing was found.
  RigCalibration calibration;
  /// Where this frame's map is in the world, by the registered tags seen until now; T_world_body is
  /// its product with T_map_body. Absent without a pose, before a registered tag was seen, and from
  /// systems that do not tell. Later tags and adjustments may move it.
  std::optional<Pose> T_world_map{};
};

/// The final result of a SLAM system, after all corrections.
struct SlamSummary {
  Trajectory trajectory;  ///< T_map_body of every frame that has a pose
  Trajectory keyframes;
  std::size_t landmarks = 0;
  /// The system's own estimate of the map's pose in the world, from registered tags; absent if it
  /// has none.
  std::optional<Pose> T_world_map{};
};

/// The test bench's interface of a SLAM system. Its only input is frames: images, wheel and
/// inertial samples; the rig's calibration and the registered tags are given at construction.
class SlamSystem {
 public:
  virtual ~SlamSystem() = default;

  /// Processes the next frame, in the order of the stamps, synchronously.
  virtual Estimate process(const Frame& frame) = 0;

  /// Completes pending work and returns the result.
  virtual SlamSummary finish() = 0;

  /// Wall-clock times of its stages.
  virtual const StageTimes& times() const = 0;
};

}  // namespace vinebench
