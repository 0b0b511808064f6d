// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/recorded_images.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"

namespace vinebench::harness {

cv::Mat read_grey(const std::filesystem::path& file) {
  return grey_of_decoded(read_image(file, cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION));
}

cv::Mat read_grey(const Recording& recording, const std::filesystem::path& image) {
  return recording.store != nullptr ? recording.store->read_grey(image) : read_grey(image);
}

bool has_image(const Recording& recording, const std::filesystem::path& image) {
  std::error_code ignored;
  if (image.empty()) return false;
  return recording.store != nullptr || std::filesystem::exists(image, ignored);
}

cv::Mat grey_of_decoded(const cv::Mat& image) {
  if (image.empty() || image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Size first_image_size(const Recording& recording, std::size_t camera) {
  for (const RecordedFrame& frame : recording.frames) {
    const std::filesystem::path& file = frame.images[camera];
    if (file.empty()) continue;
    try {
      const cv::Mat image = read_grey(recording, file);
      if (!image.empty()) return image.size();
    } catch (const Error&) {  // a fault of that frame, which is recorded when it is replayed
    }
  }
  return {};
}

}  // namespace vinebench::harness
