// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/flow/flow_writer.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <utility>

#include "core/files/files.h"
#include "core/truth/body_flow.h"
#include "core/truth/labels.h"
#include "core/util/error.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/format/image_writer.h"

namespace vinebench::harness {

namespace fs = std::filesystem;

FlowTruth flow_between(const DatasetFrame& a, const DatasetFrame& b, std::size_t camera,
                       const Pose& T_body_cam) {
  TruthView from = a.truth.views.at(camera);
  const TruthView& to = b.truth.views.at(camera);
  const cv::Mat rover = from.image.labels == static_cast<int>(Label::kRover);
  if (cv::countNonZero(rover) > 0) {
    from.image.motion = from.image.motion.clone();  // the frame's own stays as it is
    const Pose T_cam_body = T_body_cam.inverse();
    move_body(from.camera, from.T_world_cam, from.T_world_cam * T_cam_body,
              to.T_world_cam * T_cam_body, rover, from.image.depth, from.image.motion);
  }
  return optical_flow(from, to);
}

cv::Mat kitti_flow(const cv::Mat& flow) {
  cv::Mat codes(flow.size(), CV_16UC3);
  for (int y = 0; y < flow.rows; ++y) {
    const auto* f = flow.ptr<cv::Vec2f>(y);
    auto* code = codes.ptr<cv::Vec3w>(y);
    for (int x = 0; x < flow.cols; ++x) {
      const double u = static_cast<double>(f[x][0]) * kFlowSteps + kFlowZero + 0.5;
      const double v = static_cast<double>(f[x][1]) * kFlowSteps + kFlowZero + 0.5;
      const auto fits = [](double step) {
        return step >= 0 && step < kMostPngCode + 1;
      };  // not NaN
      code[x] = fits(u) && fits(v)
                    ? cv::Vec3w(static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v), 1)
                    : cv::Vec3w(0, 0, 0);
    }
  }
  return codes;
}

FlowWriter::FlowWriter(const Folders& folders, const RecordingNotes& notes)
    : folders_(folders), cameras_(notes.true_cameras) {
  for (const RigCamera& camera : cameras_) {
    if (camera.model.has_distortion()) {
      fail("flow: camera '{}' has lens distortion, expected ideal pinholes", camera.name);
    }
    if (!folders.kitti.empty()) make_folder(folders.kitti / camera.name);
    if (!folders.kitti.empty()) make_folder(folders.kitti / "visible" / camera.name);
    if (!folders.flo.empty()) make_folder(folders.flo / camera.name);
  }
}

std::vector<FileTask> FlowWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  const std::shared_ptr<const DatasetFrame> before = std::exchange(before_, frame);
  std::vector<FileTask> tasks;
  if (before == nullptr) return tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!delivered(*before, i) || !delivered(*frame, i)) continue;
    const fs::path kitti = folders_.kitti / cameras_[i].name / numbered(before->number, "png");
    const fs::path flo = folders_.flo / cameras_[i].name / numbered(before->number, "flo");
    const auto truth = [this, before, frame, i] {
      return flow_between(*before, *frame, i, cameras_[i].T_body_cam);
    };
    if (folders_.kitti.empty()) {
      tasks.push_back(
          {fmt::format("flo {}", i), flo, [truth] { return encode_flo(truth().flow); }});
      continue;
    }
    // One computation gives all files; its thread writes the others too.
    const fs::path mask =
        folders_.kitti / "visible" / cameras_[i].name / numbered(before->number, "png");
    tasks.push_back({fmt::format("flow {}", i), kitti, [this, truth, mask, flo] {
                       const FlowTruth flow = truth();
                       write_file_atomically(mask, encode_png(flow.visible));
                       if (!folders_.flo.empty()) write_file_atomically(flo, encode_flo(flow.flow));
                       return encode_png(kitti_flow(flow.flow), PngContent::kNoise);
                     }});
  }
  return tasks;
}

}  // namespace vinebench::harness
