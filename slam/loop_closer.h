// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slam/config.h"
#include "slam/estimator_rig.h"
#include "slam/map.h"

namespace vinebench {

/// Loop closing by tags (paper, Sect. III-B): a tag that was seen, left, and is seen again ties the
/// two visits together; global bundle adjustment spreads the correction over all poses and
/// landmarks.
class LoopCloser {
 public:
  LoopCloser(const SlamConfig& config, const EstimatorRig& rig, std::vector<RegisteredTag> tags)
      : config_(config), rig_(rig), registered_(std::move(tags)) {}

  /// Takes from a map that was loaded how it lies in the world.
  void take_over(const Map& map);

  /// The body's pose in the world by the first registered tag among the sightings, if any.
  std::optional<Pose> world_pose(const std::vector<TagSighting>& sightings) const;

  /// The body's pose in the map by a tag that the map knows, if one is among the sightings.
  std::optional<Pose> map_pose(const std::vector<TagSighting>& sightings, Map& map) const;

  /// Whether a tag of this frame was seen before, in a keyframe, and left since: a loop to close.
  bool sees_loop(const FrameFeatures& frame, double path_length) const;

  /// Enters the sightings of a frame: tags that are new to the map get a pose there.
  void note(const FrameFeatures& frame, const Pose& T_map_body, double path_length, Map& map);

  /// Closes the loop that `keyframe`, made of a frame that sees_loop, sees: moves the way since the
  /// earlier visit onto the tag's constraint, then adjusts the whole map.
  LoopClosure close(int keyframe, double path_length, Map& map);

  /// Global bundle adjustment of the map as it is.
  void adjust_globally(Map& map) const;

 private:
  /// When and where on the way a tag was last seen.
  struct Visit {
    std::string family;
    int id = 0;
    Stamp last_seen = 0;
    double path_length = 0;    ///< m, the way driven until then
    bool in_keyframe = false;  ///< a keyframe saw it, so that a loop has an earlier end
  };

  const RegisteredTag* registered(const TagSighting& sighting) const;
  const Visit* visit(const TagSighting& sighting) const;
  void remember_visit(const TagSighting& sighting, Stamp stamp, double path_length,
                      bool in_keyframe);
  const TagSighting* loop_sighting(const FrameFeatures& frame, double path_length) const;
  Pose T_body_tag(const TagSighting& sighting) const;

  SlamConfig config_;
  const EstimatorRig& rig_;
  std::vector<RegisteredTag> registered_;
  std::optional<Pose> T_map_world_;  ///< known from the first registered tag on
  std::vector<Visit> visits_;
};

}  // namespace vinebench
