// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/flow/flow_check.h"

#include <fmt/format.h>

#include "core/truth/occlusion.h"
#include "harness/datasets/depth/depth_format.h"
#include "harness/datasets/flow/flow_writer.h"

namespace vinebench::harness {

namespace {

constexpr double kTolerance = 0.1;  // px
constexpr double kAgreeing = 0.9;   // share of the pixels
constexpr double kNearest = 0.05;   // m in front of a camera

bool is_occluder(Label label) {
  for (std::size_t i = 0; i < kOccluderClasses; ++i) {
    if (label_of(static_cast<OccluderClass>(i)) == label) return true;
  }
  return false;
}

/// Whether a pixel's object may move.
bool may_move(const cv::Mat& semantic, const RecordedSequence& sequence, int y, int x) {
  if (semantic.empty()) return sequence.windy || sequence.busy;
  const auto label = static_cast<Label>(semantic.at<std::uint8_t>(y, x));
  switch (label) {
    case Label::kRover:
      return true;
    case Label::kLeaf:
    case Label::kCane:
    case Label::kBunch:
    case Label::kGrass:
      return sequence.windy;
    default:
      return sequence.busy && is_occluder(label);
  }
}

/// Where a camera sees, one frame on, what it sees now at a pixel at that depth, px.
class NextPlace {
 public:
  explicit NextPlace(const LabelImages& images) : model_(images.camera().model) {
    const std::vector<RecordedPose>& frames = images.sequence().frames;
    const Pose& T_body_cam = images.camera().T_body_cam;
    T_next_now_ = (frames[images.frame() + 1].T_world_body * T_body_cam).inverse() *
                  (frames[images.frame()].T_world_body * T_body_cam);
  }
  Eigen::Vector2d operator()(int x, int y, double depth) const {
    const Eigen::Vector3d p = T_next_now_ * (depth * model_.unproject({x, y}));
    return p.z() < kNearest ? Eigen::Vector2d(1e9, 1e9) : model_.project(p);
  }

 private:
  PinholeCamera model_;
  Pose T_next_now_;
};

}  // namespace

void check_flow_image(LabelImages& images) {
  const cv::Mat& flow = images.read("flow", CV_16UC3);
  const cv::Mat& depth = images.read("depth", CV_16UC1);
  const cv::Mat& semantic = images.read("semantic", CV_8UC1);
  if (flow.empty() || depth.empty()) return;
  if (images.frame() + 1 >= images.sequence().frames.size()) return;
  const NextPlace place(images);
  std::int64_t compared = 0;
  std::int64_t agreeing = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double z = depth.at<std::uint16_t>(y, x) * 1e-3;
      const cv::Vec3w& code = flow.at<cv::Vec3w>(y, x);  // valid, v, u
      if (z <= 0 || code[0] == 0 || may_move(semantic, images.sequence(), y, x)) continue;
      const Eigen::Vector2d expected = place(x, y, z);
      const double by_depth = (place(x, y, z + kDepthRounding) - expected).norm();
      const Eigen::Vector2d recorded(x + (code[2] - kFlowZero) / kFlowSteps,
                                     y + (code[1] - kFlowZero) / kFlowSteps);
      ++compared;
      if ((recorded - expected).norm() <= kTolerance + by_depth) ++agreeing;
    }
  }
  if (static_cast<double>(agreeing) < kAgreeing * static_cast<double>(compared)) {
    images.fault("flow",
                 fmt::format("agrees with depth and poses at {} of {} pixels", agreeing, compared));
  }
}

}  // namespace vinebench::harness
