// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/loop/loop_config.h"
#include "slam/map/map.h"
#include "slam/odometry/inertial_config.h"
#include "slam/optimisation/tag_localisation.h"

namespace vinebench::slam {

/// What LoopCloser is set by.
struct LoopCloserSettings {
  LoopConfig loop;
  double tag_size = 0.161;                   ///< m, of tags that are not registered
  int global_iterations = 25;                ///< of a global adjustment
  std::optional<InertialConfig> inertial{};  ///< of a unit that takes part
};

/// Loop closing by tags (paper, Sect. III-B): a tag that was seen, left, and is seen again ties the
/// two visits together; global bundle adjustment spreads the correction over all poses and
/// landmarks. A tag of known pose that is seen for the first time does the same with the last one.
class LoopCloser {
 public:
  LoopCloser(const LoopCloserSettings& settings, TagCameras cameras,
             std::vector<RegisteredTag> tags)
      : settings_(settings), cameras_(std::move(cameras)), registered_(std::move(tags)) {}

  /// Takes from a map that was loaded how it lies in the world.
  void take_over(const Map& map);

  /// The map's pose in the world by the first registered tag that was seen; none before that.
  std::optional<Pose> T_world_map() const {
    return T_map_world_ ? std::optional(T_map_world_->inverse()) : std::nullopt;
  }

  /// The body's pose in the world by the registered tags among the sightings; none where there are
  /// none, where they contradict each other or are ambiguous.
  std::optional<Pose> world_pose(const std::vector<TagSighting>& sightings) const;

  /// The same in the map, by tags whose place in it is known. A tag that was once found elsewhere
  /// (moved, or there are two) is left out.
  std::optional<Pose> map_pose(const std::vector<TagSighting>& sightings, const Map& map) const;

  /// Covariance of the body's pose by the surest of the sightings, in the step of step_of: that
  /// of the tag's corners and, of a registered one, its survey. Zero where there is no sighting to
  /// go by.
  Matrix6d localisation_covariance(const std::vector<TagSighting>& sightings) const;

  /// Leaves the frame those sightings that are to be believed; call it with every tracked frame
  /// before what follows. A sighting is rejected that is ambiguous, one of two of the same name, or
  /// farther from the tag's place in the map than the way driven since a tag was seen allows. One
  /// that would close a loop is held back until the next frame sees the tag in the same place.
  std::vector<RejectedTag> gate(FrameFeatures& frame, const Pose& T_map_body, double path_length,
                                const Map& map);

  /// Reports an odometry gap (a part of the path that no camera saw) before `keyframe`, and how
  /// uncertain the motion in it is: tags may be that much farther from their place in the map from
  /// here on.
  void cross_gap(double path_length, const Matrix6d& covariance, int keyframe) {
    gaps_.push_back({path_length, covariance, keyframe});
  }

  /// The body's pose by those of the sightings that lie farther from their tags' places in the map
  /// than an odometry gap since they were seen last allows. The tag was moved, or the body was
  /// carried in the gap. None where there are none of these.
  std::optional<Pose> pose_across_gap(const std::vector<TagSighting>& sightings,
                                      const Pose& T_map_body, double path_length,
                                      const Map& map) const;

  /// Takes the motion over the last gap to be unknown, and the sightings' tags to be where they
  /// were. Returns the first keyframe after the gap.
  int open_gap(const std::vector<TagSighting>& sightings, Map& map);

  /// Whether a tag of this frame was seen before, in a keyframe, and left since: a loop to close.
  bool sees_loop(const FrameFeatures& frame, double path_length) const;

  /// Enters the sightings of a frame: tags that are new to the map get a pose there.
  void record(const FrameFeatures& frame, const Pose& T_map_body, double path_length, Map& map);

  /// Closes the loop that `keyframe`, made of a frame that sees_loop, sees: moves the way since the
  /// earlier visit onto the tag's constraint, then adjusts the whole map.
  LoopClosure close(int keyframe, double path_length, const EstimatorRig& rig, Map& map);

  /// Global bundle adjustment of the map, levelled first.
  void adjust_globally(const EstimatorRig& rig, Map& map) const;

  /// Where an inertial unit takes part and one registered tag alone says how the map lies in the
  /// world: turns the map about that tag until it feels gravity along the world's vertical, as far
  /// as that is surer than the tag. Global adjustment would find this turn last, as all of its
  /// factors but the tag's corners allow it.
  void level(Map& map) const;

 private:
  /// When and where on the way a tag was last seen.
  struct Visit {
    std::string family;
    int id = 0;
    Stamp last_seen = 0;
    double path_length = 0;              ///< m, the way driven until then
    bool in_keyframe = false;            ///< a keyframe saw it: a loop has an earlier end
    Matrix6d mapped = Matrix6d::Zero();  ///< covariance of the place it was mapped at
  };
  /// An odometry gap.
  struct Gap {
    double path_length = 0;  ///< m, the way driven until its end
    Matrix6d covariance = Matrix6d::Zero();
    int keyframe = 0;  ///< the first one after it
  };
  /// A sighting that would close a loop.
  struct Return {
    TagSighting sighting;
    Stamp stamp = 0;
    Pose T_map_tag;
  };

  const RegisteredTag* registered(const TagSighting& sighting) const;
  const Visit* visit(const TagSighting& sighting) const;
  const Visit* reference(const TagSighting& sighting) const;
  bool crossed_gap(const TagSighting& sighting) const;
  bool was_left(const TagSighting& sighting, Stamp stamp, double path_length) const;
  const TagSighting* loop_sighting(const FrameFeatures& frame, double path_length) const;
  void remember_visit(const TagSighting& sighting, Stamp stamp, double path_length,
                      bool in_keyframe);

  std::optional<PlacedSighting> placed(const TagSighting& sighting, const Map& map) const;
  Matrix6d covariance(const TagSighting& sighting) const;
  Matrix6d survey_covariance(const TagSighting& sighting) const;
  std::optional<Matrix6d> place_covariance(const MapTag& tag, const Map& map) const;
  Matrix6d drift(double since, double path_length) const;
  bool is_in_place(const TagSighting& sighting, const Pose& T_map_body, double path_length,
                   const Map& map) const;
  bool is_doubled(const TagSighting& sighting, const FrameFeatures& frame, const Pose& T_map_body,
                  double path_length, const Map& map) const;
  bool is_confirmed(const Return& now) const;
  void reject(const TagSighting& sighting);
  void add_tag(const TagSighting& sighting, const Pose& T_map_body, Map& map);

  LoopCloserSettings settings_;
  TagCameras cameras_;
  std::vector<RegisteredTag> registered_;
  std::optional<Pose> T_map_world_;  ///< known from the first registered tag on
  std::vector<Visit> visits_;
  std::vector<Gap> gaps_;                              ///< in the order of the way
  std::vector<Return> returns_;                        ///< of the last frame judged
  std::vector<std::pair<std::string, int>> rejected_;  ///< found elsewhere than the map has them
};

}  // namespace vinebench::slam
