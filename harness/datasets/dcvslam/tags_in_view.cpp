// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dcvslam/tags_in_view.h"

#include <algorithm>

namespace vinebench::harness {
namespace {

std::array<Eigen::Vector2d, 4> corners_of(const PinholeCamera& camera, const Pose& T_cam_tag,
                                          double size) {
  const double h = size / 2;
  return {camera.project(T_cam_tag * Eigen::Vector3d(-h, h, 0)),
          camera.project(T_cam_tag * Eigen::Vector3d(h, h, 0)),
          camera.project(T_cam_tag * Eigen::Vector3d(h, -h, 0)),
          camera.project(T_cam_tag * Eigen::Vector3d(-h, -h, 0))};
}

}  // namespace

std::vector<TagInView> tags_in_view(const DatasetFrame& frame, const RecordingNotes& notes) {
  std::vector<TagInView> found;
  const Rig rig = notes.rig.make();
  for (const int index : frame.truth.visible_tags) {
    const WorldTag& tag = notes.world_tags.at(static_cast<std::size_t>(index));
    for (const int number : rig.tag_cameras) {
      const auto camera = static_cast<std::size_t>(number);
      const RigCamera& mounted = notes.true_cameras.at(camera);
      const Pose T_cam_tag =
          (frame.truth.T_world_body * mounted.T_body_cam).inverse() * tag.T_world_tag;
      if (T_cam_tag.translation.z() <= 0) continue;
      const auto corners = corners_of(mounted.model, T_cam_tag, tag.size);
      const auto inside = [&](const Eigen::Vector2d& c) { return mounted.model.contains(c); };
      if (std::ranges::all_of(corners, inside)) found.push_back({camera, tag, T_cam_tag, corners});
    }
  }
  return found;
}

}  // namespace vinebench::harness
