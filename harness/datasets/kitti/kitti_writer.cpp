// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_writer.h"

#include <fmt/format.h>

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/format/rectified.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

/// Three rows of four numbers, row by row.
std::string twelve(const Eigen::Matrix<double, 3, 4>& m) {
  std::string text;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : " ", m(i / 4, i % 4));
  }
  return text;
}

Eigen::Matrix<double, 3, 4> kitti_projection(const PinholeCamera& c, double shift) {
  Eigen::Matrix<double, 3, 4> P;
  P << c.fx, 0, c.cx, shift, 0, c.fy, c.cy, 0, 0, 0, 1, 0;
  return P;
}

/// The pair's cameras as P0 and P1, and again, for colour images, as P2 and P3.
std::string calibration(const Rig& rig, const StereoPair& pair) {
  const PinholeCamera& left = rig.cameras[static_cast<std::size_t>(pair.left)].model;
  const PinholeCamera& right = rig.cameras[static_cast<std::size_t>(pair.right)].model;
  std::string text;
  for (int i = 0; i < 4; ++i) {
    const bool second = i % 2 == 1;
    const double shift = second ? -right.fx * rig.baseline(pair) : 0;
    text += fmt::format("P{}: {}\n", i, twelve(kitti_projection(second ? right : left, shift)));
  }
  return text;
}

StereoPair rectified_pair(const Rig& rig) {
  if (rig.stereo_pairs.empty()) fail("kitti: expected a stereo pair among the cameras");
  if (!is_rectified(rig, rig.stereo_pairs.front())) {
    fail("kitti: pair '{}' is not rectified, expected a rectified pair",
         rig.stereo_pairs.front().name);
  }
  return rig.stereo_pairs.front();
}

}  // namespace

KittiWriter::KittiWriter(const fs::path& folder, const RecordingNotes& notes, bool colour)
    : folder_(make_folder(folder)),
      colour_(colour),
      pair_(rectified_pair(notes.rig.make())),
      T_body_left_(notes.true_cameras.at(static_cast<std::size_t>(pair_.left)).T_body_cam),
      times_(folder / "times.txt"),
      poses_(folder / "poses.txt") {
  for (int i = 0; i < (colour ? 4 : 2); ++i) make_folder(folder / fmt::format("image_{}", i));
  const Rig rig = notes.rig.make();
  write_file_atomically(folder / "calib.txt", calibration(rig, pair_));
  const auto name = [&](int camera) { return rig.cameras[static_cast<std::size_t>(camera)].name; };
  const RecordingNotes of_pair = with_cameras(notes, {name(pair_.left), name(pair_.right)});
  write_file_atomically(folder / "rig.yaml", format_yaml(of_pair.rig));
  write_file_atomically(folder / "slam.yaml", format_yaml(notes.slam));
}

std::vector<FileTask> KittiWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (int i = 0; i < (colour_ ? 4 : 2); ++i) {
    const auto camera = static_cast<std::size_t>(i % 2 == 0 ? pair_.left : pair_.right);
    if (frame->frame.images[camera].empty()) continue;
    tasks.push_back(
        camera_image(frame, camera, i >= 2,
                     folder_ / fmt::format("image_{}", i) / numbered(frame->number, "png")));
  }
  return tasks;
}

void KittiWriter::commit(const DatasetFrame& frame) {
  const Pose T_world_left = frame.truth.T_world_body * T_body_left_;
  if (!T_world_first_) T_world_first_ = T_world_left;
  const Pose T_first_left = T_world_first_->inverse() * T_world_left;
  times_.append(format_seconds(frame.frame.stamp) + "\n");
  poses_.append(twelve(T_first_left.matrix().topRows<3>()) + "\n");
}

}  // namespace vinebench::harness
