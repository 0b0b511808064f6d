// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "harness/report/tick_events.h"
#include "python/systems.h"

namespace vinebench::python {
namespace {

py::object rejection_of(const Estimate& estimate, const TagSighting& tag) {
  const auto same = [&](const RejectedTag& rejected) {
    return rejected.family == tag.family && rejected.id == tag.id && rejected.camera == tag.camera;
  };
  const auto found = std::ranges::find_if(estimate.rejected_tags, same);
  if (found == estimate.rejected_tags.end()) return py::none();
  return py::str(harness::name_of(found->reason));
}

py::list tags_of(const Rig& rig, const Estimate& estimate) {
  py::list tags;
  for (const TagSighting& tag : estimate.tags) {
    Eigen::Matrix<double, 4, 2> corners;
    for (Eigen::Index i = 0; i < 4; ++i) corners.row(i) = tag.corners[static_cast<std::size_t>(i)];
    py::dict entry;
    entry["camera"] = rig.cameras.at(static_cast<std::size_t>(tag.camera)).name;
    entry["family"] = tag.family;
    entry["id"] = tag.id;
    entry["corners"] = corners;
    entry["T_camera_tag"] = tag.T_cam_tag.matrix();
    entry["rejected"] = rejection_of(estimate, tag);
    tags.append(entry);
  }
  return tags;
}

py::object closure_of(const Estimate& estimate) {
  if (!estimate.loop_closure) return py::none();
  const LoopClosure& closure = *estimate.loop_closure;
  py::dict entry;
  entry["tag_id"] = closure.tag_id;
  entry["earlier"] = closure.earlier;
  entry["later"] = closure.later;
  entry["T_earlier_later"] = closure.T_earlier_later.matrix();
  entry["correction"] = closure.correction;
  return entry;
}

}  // namespace

py::dict dict_of(const Rig& rig, const Estimate& estimate) {
  py::dict counts;
  for (std::size_t i = 0; i < estimate.cameras.size() && i < rig.cameras.size(); ++i) {
    const CameraCounts& c = estimate.cameras[i];
    counts[py::str(rig.cameras[i].name)] =
        py::make_tuple(c.features, c.stereo, c.matches, c.inliers);
  }
  py::dict entry;
  entry["stamp"] = estimate.stamp;
  entry["status"] = static_cast<int>(estimate.status);
  entry["T_map_body"] = estimate.T_map_body ? py::cast(estimate.T_map_body->matrix()) : py::none();
  entry["covariance"] = estimate.covariance;
  entry["cameras"] = counts;
  entry["tags"] = tags_of(rig, estimate);
  entry["keyframe"] = estimate.keyframe;
  entry["loop_closure"] = closure_of(estimate);
  entry["T_world_map"] =
      estimate.T_world_map ? py::cast(estimate.T_world_map->matrix()) : py::none();
  return entry;
}

py::dict dict_of(const SlamSummary& summary) {
  py::dict entry;
  entry["trajectory"] = rows_of(summary.trajectory);
  entry["keyframes"] = rows_of(summary.keyframes);
  entry["landmarks"] = summary.landmarks;
  entry["T_world_map"] = summary.T_world_map ? py::cast(summary.T_world_map->matrix()) : py::none();
  return entry;
}

}  // namespace vinebench::python
