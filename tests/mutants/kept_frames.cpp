// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/mutants/kept_frames.h"

#include <opencv2/imgproc.hpp>

namespace vinebench::mutants {

KeptFrames::KeptFrames(FrameSource& source) : rig_(source.rig()) {
  while (auto sample = source.next()) {
    for (cv::Mat& image : sample->frame.images) {
      if (image.channels() != 3) continue;
      cv::Mat grey;
      cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
      image = grey;
    }
    samples_.push_back(std::move(*sample));
  }
}

std::optional<Sample> KeptFrames::next() {
  if (next_ == samples_.size()) return std::nullopt;
  return samples_[next_++];
}

}  // namespace vinebench::mutants
