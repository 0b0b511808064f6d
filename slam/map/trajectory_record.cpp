// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/trajectory_record.h"

namespace vinebench::slam {

void TrajectoryRecord::add(Stamp stamp, const Keyframe& keyframe, const Pose& T_map_body,
                           bool reckoned) {
  records_.push_back({stamp, keyframe.id, keyframe.T_map_body.inverse() * T_map_body, reckoned});
}

void TrajectoryRecord::withdraw_reckoned(int keyframe) {
  std::erase_if(records_, [&](const Record& record) {
    return record.reckoned && record.keyframe == keyframe;
  });
}

Trajectory TrajectoryRecord::trajectory(const Map& map) const {
  Trajectory trajectory;
  trajectory.reserve(records_.size());
  for (const Record& record : records_) {
    trajectory.push_back(
        {record.stamp, map.keyframe(record.keyframe).T_map_body * record.T_keyframe_body});
  }
  return trajectory;
}

}  // namespace vinebench::slam
