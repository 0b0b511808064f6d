// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slam/loop/loop_config.h"
#include "slam/loop/tag_dissent.h"
#include "slam/loop/tag_survey.h"
#include "slam/map/map.h"
#include "slam/optimisation/tag_localisation.h"

namespace vinebench::slam {

/// What is known of the tags beforehand and of where and when they were seen, and so, which
/// sightings are to be believed.
class TagGates {
 public:
  /// `tag_size`: m, of tags that are not registered.
  TagGates(const LoopConfig& config, double tag_size, TagCameras cameras,
           std::vector<RegisteredTag> tags)
      : config_(config),
        tag_size_(tag_size),
        cameras_(std::move(cameras)),
        registered_(with_accuracy(std::move(tags), config.survey())) {}

  const TagCameras& cameras() const { return cameras_; }

  /// A tag that is registered and not found to stand elsewhere; null for none.
  template <class Name>
  const RegisteredTag* registered(const Name& tag) const {
    return is_disowned(tag.family, tag.id) ? nullptr : told(tag.family, tag.id);
  }

  /// Of the tag's pose against the body.
  Matrix6d covariance(const TagSighting& sighting) const;

  /// Of a registered tag in the world, in its own frame; zero of others.
  Matrix6d survey_covariance(const TagSighting& sighting) const;

  /// Where the tag is in the map, if that is known: it was mapped, or it is registered and the map
  /// lies in the world.
  std::optional<PlacedSighting> placed(const TagSighting& sighting, const Map& map) const;

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

  /// Whether a sighting says well enough where the body is to close a loop by it.
  bool is_sure(const TagSighting& sighting) const;

  /// Whether a sighting says well enough where the tag is to hold the map to it.
  bool places_well(const TagSighting& sighting) const;

  /// Finds by the registered tags of a map that was loaded how it lies in the world.
  void take_over(Map& map) const;

  /// Maps a tag that is new, as the sighting has it: one that stands exactly where it was surveyed,
  /// there.
  MapTag& add_tag(const TagSighting& sighting, const Pose& T_map_body, Map& map) const;

  /// Leaves the frame those sightings that are to be believed; call it with every tracked frame
  /// before what follows. A sighting is rejected that is ambiguous, one of two of the same name, or
  /// farther from the tag's place in the map than the way driven since a tag was seen allows. One
  /// that would close a loop is held back until the next frame sees the tag in the same place, and
  /// until it is sure.
  std::vector<RejectedTag> gate(FrameFeatures& frame, const Pose& T_map_body, double path_length,
                                const Map& map);

  /// Call it after gate(), with the last keyframe before the frame still the map's last. Where more
  /// registered tags were found elsewhere and agree with each other than there are that were
  /// believed, those that were believed are what was moved, or wrongly surveyed: the map lies in
  /// the world as the many say (Map::world()), and the others are tags like any that is not
  /// registered. Where all that agree, two at least, were seen after an odometry gap and none that
  /// is believed was, the body was carried in the gap, and its pose by them is returned.
  std::optional<Pose> settle_dissent(const Pose& T_map_body, Map& map);

  /// Whether a registered tag was found elsewhere since then.
  bool has_dissent() const { return unsettled_; }

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

  /// A sighting of the frame whose tag was seen before, in a keyframe, and left since: a loop to
  /// close. A registered tag says as much as any other that was seen. Null for none.
  const TagSighting* loop_sighting(const FrameFeatures& frame, double path_length) const;

  /// Enters a sighting that was believed.
  void remember_visit(const TagSighting& sighting, Stamp stamp, double path_length,
                      bool in_keyframe);

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
  /// A sighting that needs another in the next frame.
  struct Return {
    TagSighting sighting;
    Stamp stamp = 0;
    Pose T_map_tag;
  };

  const RegisteredTag* told(const std::string& family, int id) const;
  bool is_disowned(const std::string& family, int id) const;
  const Visit* visit(const TagSighting& sighting) const;
  const Visit* reference(const TagSighting& sighting) const;
  bool crossed_gap(const TagSighting& sighting) const;
  bool was_left(const TagSighting& sighting, Stamp stamp, double path_length) const;
  Matrix6d drift(double since, double path_length) const;
  Matrix6d doubt_of_survey(const TagSighting& sighting) const;
  bool is_in_place(const TagSighting& sighting, const Pose& T_map_body, double path_length,
                   const Map& map) const;
  bool is_doubled(const TagSighting& sighting, const FrameFeatures& frame, const Pose& T_map_body,
                  double path_length, const Map& map) const;
  bool is_confirmed(const Return& now, const std::vector<Return>& before) const;
  void reject(const TagSighting& sighting);
  void hear(const Return& misplaced, double path_length, const Map& map);
  bool dissents_since_gap(const std::vector<TagWitness>& group) const;
  void adopt(const std::vector<TagWitness>& group, Map& map);

  LoopConfig config_;
  double tag_size_;
  TagCameras cameras_;
  std::vector<RegisteredTag> registered_;
  std::vector<std::pair<std::string, int>> disowned_;  ///< registered, but standing elsewhere
  std::vector<Visit> visits_;
  std::vector<Gap> gaps_;                              ///< in the order of the way
  std::vector<Return> returns_;                        ///< of the last frame judged
  std::vector<Return> misplaced_;                      ///< likewise, of registered tags
  std::vector<std::pair<std::string, int>> rejected_;  ///< found elsewhere than the map has them
  TagDissent dissent_;
  bool unsettled_ = false;  ///< something was heard since it was settled
};

}  // namespace vinebench::slam
