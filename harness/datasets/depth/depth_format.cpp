// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/depth/depth_format.h"

#include <opencv2/core.hpp>

#include "core/truth/labels.h"
#include "harness/datasets/files/png_writer.h"
#include "harness/datasets/format/image_writer.h"

namespace vinebench::harness {

namespace {

constexpr double kMillimetres = 1000;

std::unique_ptr<FormatWriter> make_depth_writer(const WriterInputs& inputs) {
  return std::make_unique<ImageWriter>(
      inputs.folder, inputs.notes, "depth", "png",
      [](const DatasetFrame& frame, std::size_t camera) {
        return encode_png(millimetres(truth_of(frame, camera).depth));
      });
}

/// The sky has no depth.
void check_depth_image(LabelImages& images) {
  const cv::Mat& depth = images.read("depth", CV_16UC1);
  const cv::Mat& semantic = images.read("semantic", CV_8UC1);
  if (depth.empty() || semantic.empty()) return;
  images.expect_none("depth", depth.size(), "has depth in the sky", [&](int y, int x) {
    const bool sky = semantic.at<std::uint8_t>(y, x) == static_cast<std::uint8_t>(Label::kSky);
    return sky && depth.at<std::uint16_t>(y, x) != 0;
  });
}

}  // namespace

cv::Mat millimetres(const cv::Mat& depth) {
  cv::Mat codes(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    const auto* from = depth.ptr<float>(y);
    auto* to = codes.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      const double mm = static_cast<double>(from[x]) * kMillimetres + 0.5;
      to[x] = mm < kMostPngCode + 1 ? static_cast<std::uint16_t>(mm) : std::uint16_t{0};
    }
  }
  return codes;
}

DatasetFormat depth_format() {
  return {.name = "depth",
          .description = "depth, 16-bit PNG in mm, 0 for sky and beyond 65.535 m",
          .truth = {.depth = true},
          .write = make_depth_writer,
          .check_image = check_depth_image};
}

}  // namespace vinebench::harness
