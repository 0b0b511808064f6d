// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/loop/loop_config.h"
#include "slam/loop/place_loops.h"
#include "slam/loop/tag_gates.h"
#include "slam/map/map.h"
#include "slam/mapping/local_mapper.h"
#include "slam/odometry/inertial_config.h"

namespace vinebench::slam {

/// What LoopCloser is set by.
struct LoopCloserSettings {
  LoopConfig loop;
  double tag_size = 0.161;                  ///< m, of tags that are not registered
  int global_iterations = 25;               ///< of a global adjustment
  std::optional<InertialNoise> inertial{};  ///< of a unit that takes part
};

/// Loop closing by tags (paper, Sect. III-B): a tag that was seen, left, and is seen again ties the
/// two visits together; global bundle adjustment spreads the correction over all poses and
/// landmarks. A tag of known pose that is seen for the first time does the same with the last one.
class LoopCloser {
 public:
  LoopCloser(const LoopCloserSettings& settings, TagCameras cameras,
             std::vector<RegisteredTag> tags)
      : settings_(settings),
        gates_(settings.loop, settings.tag_size, std::move(cameras), std::move(tags)) {}

  /// Which sightings are to be believed.
  TagGates& gates() { return gates_; }
  const TagGates& gates() const { return gates_; }

  /// Whether a tag of this frame was seen before, in a keyframe, and left since: a loop to close.
  bool sees_loop(const FrameFeatures& frame, double path_length) const {
    return gates_.loop_sighting(frame, path_length) != nullptr;
  }

  /// Enters the sightings of a frame: tags that are new to the map get a pose there.
  void record(const FrameFeatures& frame, const Pose& T_map_body, double path_length, Map& map);

  /// Closes the loop that `keyframe`, made of a frame that sees_loop, sees: moves the way since the
  /// earlier visit onto the tag's constraint, then adjusts the whole map, unless the caller does
  /// that.
  LoopClosure close(int keyframe, double path_length, const EstimatorRig& rig, Map& map,
                    bool adjusts = true);

  /// Closes the loop that a return to a place makes: moves the way since then, ties the last
  /// keyframes to what was mapped there, and adjusts the whole map, unless the caller does that.
  LoopClosure close(const PlaceReturn& place, int keyframe, const LocalMapper& mapper,
                    const EstimatorRig& rig, Map& map, bool adjusts = true) const;

  /// Global bundle adjustment of the map, levelled first. The world stays where it is in the map.
  void adjust_globally(const EstimatorRig& rig, Map& map) const;

  /// Where an inertial unit takes part and one registered tag alone says how the map lies in the
  /// world: turns the map about that tag until it feels gravity along the world's vertical, as far
  /// as that is surer than the tag. Global adjustment would find this turn last, as all of its
  /// factors but the tag's corners allow it.
  void level(Map& map) const;

 private:
  /// Of a loop by a tag.
  struct EarlierEnd {
    int keyframe = 0;
    const TagSighting* sighting = nullptr;
    Pose T_earlier_tag;                      ///< of the tag that the later end sees
    Matrix6d covariance = Matrix6d::Zero();  ///< of T_earlier_later, in the step of the later body
  };

  void add_tag(const TagSighting& sighting, const Pose& T_map_body, Map& map) const;
  std::optional<EarlierEnd> earlier_end(const Keyframe& later, const TagSighting& seen,
                                        const Map& map) const;
  Matrix6d loop_covariance(const TagSighting& later, const TagSighting& earlier,
                           const Pose& T_earlier_tag) const;
  std::optional<Matrix6d> place_covariance(const MapTag& tag, const Map& map) const;

  LoopCloserSettings settings_;
  TagGates gates_;
  bool world_is_sure_ = true;  ///< where it lies in the map: of one that was loaded, or by a loop
};

}  // namespace vinebench::slam
