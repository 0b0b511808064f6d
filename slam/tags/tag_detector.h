// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/camera.h"
#include "core/slam_system.h"

namespace vinebench::slam {

struct TagDetectorConfig {
  std::vector<std::string> families{"tag36h11"};  ///< of AprilTag, that are searched for
  double size = 0.161;    ///< m, side of the black square, for tags that are not registered
  double decimate = 2.0;  ///< the search runs on an image smaller by this; corners are refined on
                          ///< the full one
  double min_margin =
      30;               ///< decision margin (grey levels) below which a detection is not believed
  int max_hamming = 1;  ///< corrected bits above which a detection is not believed
  template <class Archive>
  void serialize(Archive& archive) {
    archive("families", families);
    archive("size", size, Range::positive());
    archive("decimate", decimate, Range::between(1, 8));
    archive("min_margin", min_margin, Range::non_negative());
    archive("max_hamming", max_hamming, Range::between(0, 3));
  }
};

/// Finds AprilTags in an image (AprilTag 3) and where they stand against the camera.
class TagDetector {
 public:
  TagDetector(const TagDetectorConfig& config, std::vector<RegisteredTag> registered);
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;
  ~TagDetector();

  /// `grey` is CV_8UC1. Tags cut by the image's edge are left out. Sightings in ascending order
  /// of (family, id); camera is copied into each.
  std::vector<TagSighting> detect(const cv::Mat& grey, const PinholeCamera& model, int camera);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vinebench::slam
