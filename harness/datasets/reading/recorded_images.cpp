// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/recorded_images.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace vinebench::harness {

cv::Mat read_grey(const std::filesystem::path& file) {
  cv::Mat image;
  try {
    image = cv::imread(file.string(), cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {  // an invalid size in a damaged header
    return {};
  }
  if (image.empty() || image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Size first_image_size(const Recording& recording, std::size_t camera) {
  for (const RecordedFrame& frame : recording.frames) {
    const std::filesystem::path& file = frame.images[camera];
    const cv::Mat image = file.empty() ? cv::Mat() : read_grey(file);
    if (!image.empty()) return image.size();
  }
  return {};
}

}  // namespace vinebench::harness
