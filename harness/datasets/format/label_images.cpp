// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/label_images.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

LabelImages::LabelImages(const RecordedSequence& sequence, std::size_t frame, std::size_t camera,
                         std::vector<DatasetFault>& faults)
    : sequence_(sequence), frame_(frame), camera_(camera), faults_(faults) {}

std::string LabelImages::file_of(const std::string& format) const {
  return fmt::format("{}/{}/{}", format, camera().name,
                     numbered(static_cast<std::int64_t>(frame_), "png"));
}

const cv::Mat& LabelImages::read(const std::string& format, int type) {
  const auto [place, first] = read_.try_emplace(format);
  cv::Mat& image = place->second;
  const std::string file = file_of(format);
  if (!first || !sequence_.has(file)) return image;
  ++images_;
  try {
    image = read_image(sequence_.folder / file, cv::IMREAD_UNCHANGED);
  } catch (const Error& error) {
    fault(format, error.what());
    return image;
  }
  const PinholeCamera& model = camera().model;
  if (image.size() != cv::Size(model.width, model.height) || image.type() != type) {
    image = cv::Mat();
    fault(format, fmt::format("is not a complete image of {} x {} pixels of its type", model.width,
                              model.height));
  }
  return image;
}

void LabelImages::fault(const std::string& format, const std::string& problem) {
  faults_.push_back({file_of(format), problem});
}

}  // namespace vinebench::harness
