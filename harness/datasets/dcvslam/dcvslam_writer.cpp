// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dcvslam/dcvslam_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/dcvslam/tags_in_view.h"
#include "harness/datasets/format/rectified.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPairs = 2;  // supported by DC-VSLAM
constexpr std::array<std::array<const char*, 2>, kPairs> kFolders{
    {{"left", "right"}, {"leftBack", "rightBack"}}};
constexpr const char* kTagHeader =
    "# the truth, not detections: every tag that is completely and visibly in view, without noise\n"
    "#timestamp [ns],frame,camera,family,id,size [m],p_x [m],p_y [m],p_z [m],q_x [],q_y [],q_z [],"
    "q_w [],u0 [px],v0 [px],u1 [px],v1 [px],u2 [px],v2 [px],u3 [px],v3 [px]\n";

std::size_t pairs_of(const Rig& rig) {
  return std::min(kPairs, rig.stereo_pairs.size());
}

Rig checked(const Rig& rig) {
  if (rig.stereo_pairs.empty()) fail("dcvslam: expected a stereo pair among the cameras");
  for (std::size_t i = 0; i < pairs_of(rig); ++i) {
    if (is_rectified(rig, rig.stereo_pairs[i])) continue;
    fail("dcvslam: pair '{}' is not rectified, expected rectified pairs", rig.stereo_pairs[i].name);
  }
  return rig;
}

std::string matrix(const std::string& indent, const std::string& key, const Pose& T) {
  const Eigen::Matrix4d m = T.matrix();
  std::string data;
  for (Eigen::Index i = 0; i < 16; ++i) {
    data += fmt::format("{}{}", i == 0 ? "" : ", ", m(i / 4, i % 4));
  }
  return fmt::format("{0}{1}:\n{0}  rows: 4\n{0}  cols: 4\n{0}  dt: d\n{0}  data: [{2}]\n", indent,
                     key, data);
}

/// One pair's keys; `suffix` is empty for the front and "B" for the back.
std::string describe_pair(const Rig& rig, const StereoPair& pair, const std::string& suffix) {
  std::string text;
  for (const int index : {pair.left, pair.right}) {
    const PinholeCamera& c = rig.cameras[static_cast<std::size_t>(index)].model;
    text += fmt::format(
        "Camera{}_{}:\n  fx: {}\n  fy: {}\n  cx: {}\n  cy: {}\n  k1: 0.0\n  k2: 0.0\n  p1: 0.0\n"
        "  p2: 0.0\n  k3: 0.0\n",
        suffix, index == pair.left ? "l" : "r", c.fx, c.fy, c.cx, c.cy);
  }
  const PinholeCamera& c = rig.cameras[static_cast<std::size_t>(pair.left)].model;
  return text + fmt::format("Camera{}:\n  width: {}\n  height: {}\n  fps: {}\n  bl: {}\n", suffix,
                            c.width, c.height, rig.rate_hz, rig.baseline(pair));
}

const Pose& left_camera(const Rig& rig, std::size_t pair) {
  return rig.cameras[static_cast<std::size_t>(rig.stereo_pairs[pair].left)].T_body_cam;
}

/// With one pair, the second has the pose of the first.
std::string settings(const Rig& rig, std::int64_t frames) {
  const bool dual = pairs_of(rig) == kPairs;
  std::string text = fmt::format(
      "# Run DC-VSLAM's {} in this folder: {} config.yaml\n"
      "rectified: true\nrectifiedB: true\nnumOfFrames: {}\nimagesPath: \"./\"\n"
      "fileExtension: \".png\"\n",
      dual ? "DualCam" : "SingleCam", dual ? "DualCam" : "SingleCam", frames);
  text += describe_pair(rig, rig.stereo_pairs[0], "");
  text += describe_pair(rig, rig.stereo_pairs[dual ? 1 : 0], "B");
  text +=
      "FE:\n  nFeatures: 1000\n  nLevels: 8\n  imScale: 1.2\n  edgeThreshold: 19\n"
      "  maxFastThreshold: 20\n  minFastThreshold: 7\n  patchSize: 31\n";
  const Pose T_front_body = left_camera(rig, 0).inverse();
  text += "Multi:\n" + matrix("  ", "T_c1_c2", T_front_body * left_camera(rig, dual ? 1 : 0));
  if (!rig.tag_cameras.empty()) {
    const auto camera = static_cast<std::size_t>(rig.tag_cameras.front());
    text += matrix("", "T_c1_AT", T_front_body * rig.cameras[camera].T_body_cam);
  }
  return text;
}

}  // namespace

DcvslamWriter::DcvslamWriter(const fs::path& folder, const RecordingNotes& notes, bool colour)
    : folder_(make_folder(folder)),
      colour_(colour),
      notes_(notes),
      rig_(checked(notes.rig.make())),
      tags_(folder / "tags.csv") {
  for (std::size_t pair = 0; pair < pairs_of(rig_); ++pair) {
    for (const char* camera : kFolders[pair]) make_folder(folder / camera);
  }
  tags_.append(kTagHeader);
  write_file_atomically(folder / "config.yaml", settings(rig_, 0));
}

std::vector<FileTask> DcvslamWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t pair = 0; pair < pairs_of(rig_); ++pair) {
    const std::array cameras{rig_.stereo_pairs[pair].left, rig_.stereo_pairs[pair].right};
    for (std::size_t side = 0; side < cameras.size(); ++side) {
      const auto camera = static_cast<std::size_t>(cameras[side]);
      if (frame->frame.images[camera].empty()) continue;
      tasks.push_back(camera_image(
          frame, camera, colour_, folder_ / kFolders[pair][side] / numbered(frame->number, "png")));
    }
  }
  return tasks;
}

void DcvslamWriter::commit(const DatasetFrame& frame) {
  append_tags(frame);
  write_file_atomically(folder_ / "config.yaml", settings(rig_, frame.number + 1));
}

void DcvslamWriter::append_tags(const DatasetFrame& frame) {
  std::string rows;
  for (const TagInView& found : tags_in_view(frame, notes_)) {
    const Eigen::Vector3d& p = found.T_cam_tag.translation;
    const Eigen::Quaterniond& q = found.T_cam_tag.rotation;
    rows += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", frame.frame.stamp, frame.number,
                        rig_.cameras[found.camera].name, found.tag.family, found.tag.id,
                        found.tag.size, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
    for (const Eigen::Vector2d& c : found.corners) rows += fmt::format(",{},{}", c.x(), c.y());
    rows += "\n";
  }
  tags_.append(rows);
}

}  // namespace vinebench::harness
