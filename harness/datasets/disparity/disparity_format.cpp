// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/disparity/disparity_format.h"

#include <fmt/format.h>

#include <cmath>

#include "core/util/error.h"
#include "harness/datasets/depth/depth_format.h"
#include "harness/datasets/files/png_writer.h"
#include "harness/datasets/format/image_writer.h"
#include "harness/datasets/format/rectified.h"

namespace vinebench::harness {

namespace {

namespace fs = std::filesystem;

constexpr double kSteps = 256;  // per px

class DisparityWriter : public FormatWriter {
 public:
  DisparityWriter(const std::filesystem::path& folder, const RecordingNotes& notes);
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  struct Camera {
    std::size_t camera;
    std::string name;
    double focal_baseline;  ///< px m
  };
  std::filesystem::path folder_;
  std::vector<Camera> cameras_;
};

DisparityWriter::DisparityWriter(const fs::path& folder, const RecordingNotes& notes)
    : folder_(folder) {
  Rig rig = notes.rig.make();
  rig.cameras = notes.true_cameras;
  if (rig.stereo_pairs.empty()) fail("disparity: expected a stereo pair among the cameras");
  for (const StereoPair& pair : rig.stereo_pairs) {
    if (!is_rectified(rig, pair)) {
      fail("disparity: the cameras of pair '{}' are not rectified as they truly are", pair.name);
    }
    const auto left = static_cast<std::size_t>(pair.left);
    cameras_.push_back(
        {left, rig.cameras[left].name, rig.cameras[left].model.fx * rig.baseline(pair)});
    make_folder(folder / cameras_.back().name);
  }
}

std::vector<FileTask> DisparityWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (const Camera& camera : cameras_) {
    if (!delivered(*frame, camera.camera)) continue;
    tasks.push_back({fmt::format("disparity {}", camera.camera),
                     folder_ / camera.name / numbered(frame->number, "png"), [frame, &camera] {
                       const cv::Mat& depth = truth_of(*frame, camera.camera).depth;
                       cv::Mat codes(depth.size(), CV_16UC1);
                       for (int y = 0; y < depth.rows; ++y) {
                         const auto* z = depth.ptr<float>(y);
                         auto* code = codes.ptr<std::uint16_t>(y);
                         for (int x = 0; x < depth.cols; ++x) {
                           const double px = camera.focal_baseline / static_cast<double>(z[x]);
                           const double steps = px * kSteps + 0.5;
                           const bool fits = z[x] > 0 && steps < kMostPngCode + 1;
                           code[x] = fits ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
                         }
                       }
                       return encode_png(codes);
                     }});
  }
  return tasks;
}

std::unique_ptr<FormatWriter> make_disparity_writer(const WriterInputs& inputs) {
  return std::make_unique<DisparityWriter>(inputs.folder, inputs.notes);
}

/// Focal length times baseline by depth, within its own steps and depth's.
void check_disparity_image(LabelImages& images) {
  const cv::Mat& disparity = images.read("disparity", CV_16UC1);
  const cv::Mat& depth = images.read("depth", CV_16UC1);
  if (disparity.empty() || depth.empty()) return;
  const Rig& rig = images.sequence().rig;
  for (const StereoPair& pair : rig.stereo_pairs) {
    if (pair.left != static_cast<int>(images.camera_index())) continue;
    const double focal_baseline = images.camera().model.fx * rig.baseline(pair);
    images.expect_none("disparity", depth.size(), "is not focal length · baseline / depth",
                       [&](int y, int x) {
                         const double z = depth.at<std::uint16_t>(y, x) * 1e-3;
                         const int code = disparity.at<std::uint16_t>(y, x);
                         if (z <= 0 || code == 0) return false;
                         const double expected = focal_baseline / z;
                         const double tolerance = 1 / kSteps + expected / z * kDepthRounding * 1.1;
                         return std::abs(code / kSteps - expected) > tolerance;
                       });
  }
}

}  // namespace

DatasetFormat disparity_format() {
  return {.name = "disparity",
          .description = "disparity of the left cameras, 16-bit PNG in 1/256 px (KITTI)",
          .truth = {.depth = true},
          .write = make_disparity_writer,
          .check_image = check_disparity_image};
}

}  // namespace vinebench::harness
