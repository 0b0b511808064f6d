// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/truth/truth_images.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// Flow from each frame to the next one of the data set, as 16-bit PNG of KITTI (1/64 px around
/// 2^15, blue 1 where known) and as Middlebury's .flo, and with KITTI's a mask of the points
/// visible in the next frame. Throws Error for cameras with distortion.
class FlowWriter : public FormatWriter {
 public:
  struct Folders {
    std::filesystem::path kitti;  ///< none if empty
    std::filesystem::path flo;    ///< likewise
  };
  FlowWriter(const Folders& folders, const RecordingNotes& notes);
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  Folders folders_;
  std::vector<RigCamera> cameras_;
  std::shared_ptr<const DatasetFrame> before_;
};

/// True flow of a camera from one frame to the next, including the rover's own pixels.
FlowTruth flow_between(const DatasetFrame& a, const DatasetFrame& b, std::size_t camera,
                       const Pose& T_body_cam);

/// KITTI's code of a flow of 0 px; a pixel has 64.
inline constexpr double kFlowZero = 32768;
inline constexpr double kFlowSteps = 64;

/// KITTI's code of a flow, CV_16UC3 (RGB).
cv::Mat kitti_flow(const cv::Mat& flow);

}  // namespace vinebench::harness
