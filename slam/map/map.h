// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/geometry/pose.h"
#include "core/slam_system.h"
#include "core/time.h"
#include "slam/frame/frame_features.h"
#include "slam/odometry/map_gravity.h"
#include "slam/odometry/preintegrated_motion.h"
#include "slam/patches/patch_list.h"

namespace vinebench::slam {

/// What dead reckoning says of the motion between two keyframes that no landmark ties together.
struct OdometryLink {
  int from = 0;  ///< keyframe
  Pose T_from_to;
  Matrix6d covariance = Matrix6d::Identity();  ///< in the step of step_of
};

/// What an inertial unit adds to a keyframe's pose.
struct InertialState {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            ///< m/s, of the body, map frame
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();      ///< rad/s, body frame
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< m/s^2, body frame
};

struct Keyframe {
  int id = 0;
  std::shared_ptr<const FrameFeatures> frame;
  Pose T_map_body;
  std::optional<InertialState> inertial;      ///< where an inertial unit takes part
  std::optional<PreintegratedMotion> motion;  ///< likewise, since the keyframe before
  Associations landmarks;
  std::vector<PatchList> patches;    ///< of each view; none where it has no images
  std::optional<OdometryLink> link;  ///< to an earlier keyframe, after an odometry gap
  std::map<int, int> covisible;      ///< keyframe id to the number of landmarks both see

  /// Whether it came with a map that was loaded: frames of earlier runs have negative indices.
  bool inherited() const { return frame->index < 0; }
};

/// One feature of one keyframe.
struct Observation {
  int keyframe = 0;
  int view = 0;
  int feature = 0;

  bool operator==(const Observation&) const = default;
};

/// What a landmark looks like, by those who see it.
struct LandmarkLook {
  Descriptor descriptor{};  ///< the one nearest to all others that were seen of it
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< mean direction from the cameras to it
  double max_distance = 0;  ///< m, where its feature would be found on level 0 of the pyramid
};

struct Landmark : LandmarkLook {
  int id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< map frame, m
  std::vector<Observation> observations;               ///< ascending by keyframe, then view
  int first_keyframe = 0;
  bool removed = false;
};

/// Where a tag was surveyed to be, as surely as that is.
struct SurveyedPlace {
  Pose T_world_tag;
  Matrix6d covariance = Matrix6d::Identity();  ///< in the tag's own frame
};

/// A tag in the map.
struct MapTag {
  std::string family;
  int id = 0;
  double size = 0;  ///< m
  Pose T_map_tag;
  bool fixed = false;                     ///< its pose is known beforehand, exactly
  std::optional<SurveyedPlace> survey{};  ///< what else is known of it beforehand
  /// Where it is in the map is known well enough for local adjustments to hold to.
  bool sure = true;

  bool registered() const { return fixed || survey; }
};

/// Keyframes, landmarks and tags, each found by id, so that no order depends on an address.
class Map {
 public:
  explicit Map(double level_scale) : level_scale_(level_scale) {}

  std::vector<Keyframe>& keyframes() { return keyframes_; }
  const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  Keyframe& keyframe(int id) { return keyframes_[static_cast<std::size_t>(id)]; }
  const Keyframe& keyframe(int id) const { return keyframes_[static_cast<std::size_t>(id)]; }
  Landmark& landmark(int id) { return landmarks_[static_cast<std::size_t>(id)]; }
  const Landmark& landmark(int id) const { return landmarks_[static_cast<std::size_t>(id)]; }
  std::vector<Landmark>& landmarks() { return landmarks_; }
  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  std::vector<MapTag>& tags() { return tags_; }
  const std::vector<MapTag>& tags() const { return tags_; }

  /// Landmarks that began with a keyframe, removed ones too: ids ascend with the keyframes.
  std::span<const Landmark> begun_with(int keyframe) const;

  /// What self-calibration found of the rig when the map was made; empty for nothing.
  RigCalibration& calibration() { return calibration_; }
  const RigCalibration& calibration() const { return calibration_; }
  const MapTag* find_tag(const std::string& family, int id) const;
  /// Whether a tag holds the map: it is fixed, or the only registered one, whose survey says no
  /// more than where the map lies in the world.
  bool is_held(const MapTag& tag) const;

  /// T_map_world, known from the first registered tag on.
  std::optional<Pose>& world() { return T_map_world_; }
  const std::optional<Pose>& world() const { return T_map_world_; }

  /// Known where an inertial unit takes part. Files of maps have neither this nor world().
  std::optional<MapGravity>& gravity() { return gravity_; }
  const std::optional<MapGravity>& gravity() const { return gravity_; }

  /// Adds a keyframe; its associations become observations. Returns its id.
  int add_keyframe(std::shared_ptr<const FrameFeatures> frame, const Pose& T_map_body,
                   const Associations& associations);

  /// Adds a landmark that is first seen at `observation`. Returns its id.
  int add_landmark(const Eigen::Vector3d& position, const Observation& observation);

  /// Ties a feature to a landmark, unless either end is taken: the feature by another landmark, or
  /// the landmark in that view of that keyframe by another feature.
  bool add_observation(int landmark, const Observation& observation);

  void remove_observation(int landmark, const Observation& observation);
  void remove_landmark(int landmark);

  /// All observations of `from` go to `into`, where they are free; `from` is removed.
  void merge(int from, int into);

  /// Recomputes what a landmark looks like from its observations.
  void refresh(int landmark, const std::vector<Pose>& T_body_cams);

  /// What a landmark looks like, with keyframes where T_map_body() has them by their ids. What
  /// nobody sees looks as before.
  LandmarkLook look_of(const Landmark& landmark, const std::function<Pose(int)>& T_map_body,
                       const std::vector<Pose>& T_body_cams) const;

  /// Ids of the keyframes that share most landmarks with `keyframe`, best first.
  std::vector<int> covisible(int keyframe, int at_most) const;

  /// Number of landmarks seen by at least that many keyframes.
  std::size_t count_landmarks(int min_observations) const;

  double level_scale() const { return level_scale_; }

 private:
  void change_covisibility(const Landmark& landmark, int keyframe, int change);

  double level_scale_;
  std::vector<Keyframe> keyframes_;
  std::vector<Landmark> landmarks_;
  std::vector<MapTag> tags_;
  RigCalibration calibration_;
  std::optional<MapGravity> gravity_;
  std::optional<Pose> T_map_world_;
};

/// Number of different keyframes among a landmark's observations.
int count_keyframes(const Landmark& landmark);

}  // namespace vinebench::slam
