// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "slam/camera/estimator_rig.h"
#include "slam/loop/loop_closer.h"
#include "slam/map/map.h"
#include "slam/tracking/relocaliser.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// Whether a frame has enough to begin a map, or a part of it, by.
bool sees_well(const FrameFeatures& frame);

/// Finds the body in the map where tracking has lost it or follows it to where a tag says that it
/// is not.
class Recovery {
 public:
  /// The tracker is led by it. All live as long as it does.
  Recovery(Tracker& tracker, LoopCloser& loop_closer, const EstimatorRig& rig, Map& map)
      : tracker_(tracker), loop_closer_(loop_closer), rig_(rig), map_(map) {}

  /// Where in a loaded map the body is: by a tag that the map knows, else by appearance of the
  /// place. Either must be borne out by tracking from there.
  TrackedFrame relocalise(const std::shared_ptr<FrameFeatures>& frame);

  /// Reports a frame that was tracked.
  void tracked(Stamp stamp) {
    last_tracked_ = stamp;
    seeing_frames_ = 0;
    relocaliser_.forget();
  }

  /// Tracks a frame that was not tracked from where the body is by a tag that the map knows or by
  /// the looks of the place. A tag is believed; a place must be borne out by tracking there and, as
  /// long as dead reckoning says that the body is elsewhere, by all cameras, and be one that the
  /// body can have been carried to since it was tracked. True if so: then it was carried since the
  /// last keyframe.
  bool find_again(TrackedFrame& tracked);

  /// Makes a frame that sees well, but nothing of the map, one to be the map's next keyframe where
  /// dead reckoning says that it is; after a few of them in a row. False where that is not the
  /// case.
  bool restart_map(TrackedFrame& tracked, double path_length);

  /// Where a tag says that the body is, against dead reckoning over the last gap and borne out by
  /// the map: the body was carried. None where there is nothing of the kind.
  std::optional<Pose> carried_to(const TrackedFrame& tracked, double path_length) const;

  /// Moves the map since the last gap with the body to where it was carried. Returns the keyframe
  /// before the gap.
  int move_to(const Pose& T_map_body, TrackedFrame& tracked);

 private:
  Tracker& tracker_;
  LoopCloser& loop_closer_;
  const EstimatorRig& rig_;
  Map& map_;
  Relocaliser relocaliser_;
  Stamp last_tracked_ = 0;
  int seeing_frames_ = 0;  ///< in a row, that see enough and find nothing of the map
};

}  // namespace vinebench::slam
