// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"
#include "tests/support/synthetic_aisle.h"

namespace vinebench::test {

/// A perfect map of the aisle: keyframes at the true poses, landmarks at the true positions, every
/// feature associated correctly.
struct AisleMap {
  AisleMap(const SyntheticAisle& from, const std::vector<Pose>& poses)
      : aisle(from), rig(from.rig, slam::OrbConfig{}), map(slam::OrbConfig{}.scale) {
    for (const Pose& pose : poses) {
      add(aisle.frame(static_cast<std::int64_t>(map.keyframes().size()), pose), pose);
    }
  }

  /// Adds a keyframe, associates known landmarks and creates the others. Returns its id.
  int add(const std::shared_ptr<const slam::FrameFeatures>& frame, const Pose& T_map_body) {
    const int id = map.add_keyframe(frame, T_map_body, associate(*frame));
    for (std::size_t v = 0; v < frame->views.size(); ++v) {
      const auto& descriptors = frame->views[v].features.descriptors;
      for (std::size_t f = 0; f < descriptors.size(); ++f) {
        const int point = aisle.point_of(descriptors[f]);
        if (landmark_of.count(point) > 0) continue;
        landmark_of[point] =
            map.add_landmark(aisle.point(point), {id, static_cast<int>(v), static_cast<int>(f)});
      }
    }
    for (const auto& [point, landmark] : landmark_of) map.refresh(landmark, rig.T_body_cams);
    return id;
  }

  /// The true landmark of each feature, if the map has it.
  slam::Associations associate(const slam::FrameFeatures& frame) const {
    slam::Associations associations = slam::no_associations(frame);
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
      for (std::size_t f = 0; f < associations[v].size(); ++f) {
        const auto found = landmark_of.find(aisle.point_of(frame.views[v].features.descriptors[f]));
        if (found != landmark_of.end()) associations[v][f] = found->second;
      }
    }
    return associations;
  }

  const SyntheticAisle& aisle;
  slam::EstimatorRig rig;
  slam::Map map;
  std::map<int, int> landmark_of;  ///< by point of the aisle
};

/// Along the aisle, a pose every 0.25 m.
inline std::vector<Pose> straight_way() {
  std::vector<Pose> poses;
  for (int i = 0; i < 14; ++i) poses.push_back({Eigen::Quaterniond::Identity(), {0.25 * i, 0, 0}});
  return poses;
}

/// Distance of two poses' origins, m, and angle between them, rad.
inline double distance(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm();
}
inline double angle(const Pose& a, const Pose& b) {
  return angle_of(a.rotation.conjugate() * b.rotation);
}

}  // namespace vinebench::test
