// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "harness/datasets/format/recorded_sequence.h"

namespace vinebench::harness {

/// The label images of one camera at one frame in the formats of a sequence, read from the disk on
/// demand.
class LabelImages {
 public:
  /// Keeps references to the sequence and to the list of faults.
  LabelImages(const RecordedSequence& sequence, std::size_t frame, std::size_t camera,
              std::vector<DatasetFault>& faults);

  const RecordedSequence& sequence() const { return sequence_; }
  std::size_t frame() const { return frame_; }
  std::size_t camera_index() const { return camera_; }
  const RigCamera& camera() const { return sequence_.rig.cameras[camera_]; }

  /// A format's PNG, colours as BGR; empty if it is not recorded. One that is incomplete, or of
  /// another size or type than the calibration's and `type`, is a fault and empty.
  const cv::Mat& read(const std::string& format, int type);

  /// Adds a fault of that format's image.
  void fault(const std::string& format, const std::string& problem);

  /// Counts the pixels of a size that `wrong(y, x)` holds for; any is a fault of that format.
  template <class Wrong>
  void expect_none(const std::string& format, const cv::Size& size, const std::string& problem,
                   const Wrong& wrong) {
    std::int64_t count = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) count += wrong(y, x) ? 1 : 0;
    }
    if (count > 0) fault(format, fmt::format("{} at {} pixels", problem, count));
  }

  std::int64_t images() const { return images_; }  ///< that were there

 private:
  std::string file_of(const std::string& format) const;

  const RecordedSequence& sequence_;
  std::size_t frame_;
  std::size_t camera_;
  std::vector<DatasetFault>& faults_;
  std::map<std::string, cv::Mat> read_;
  std::int64_t images_ = 0;
};

}  // namespace vinebench::harness
