// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <apriltag/apriltag.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/world/tag_family.h"

namespace vinebench::test {

/// A tag found by AprilTag's detector.
struct ReadTag {
  int id = 0;
  int wrong_bits = 0;
  std::array<Eigen::Vector2d, 4> corners;  ///< px, in tag_corners' order
};

/// Corners of a tag's black square in its own frame (x right, y down), m: lower left, lower right,
/// upper right, upper left, in AprilTag's order.
inline std::array<Eigen::Vector3d, 4> tag_corners(double size) {
  const double h = size / 2;
  return {Eigen::Vector3d(-h, h, 0), {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
}

/// Detector with refined edges on the whole, undecimated image (CV_8UC1).
inline std::vector<ReadTag> read_tags(const cv::Mat& grey, const sim::TagFamily& family) {
  const std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family(detector.get(), const_cast<apriltag_family_t*>(family.get()));
  detector->quad_decimate = 1;
  detector->refine_edges = true;
  image_u8_t image{grey.cols, grey.rows, static_cast<int>(grey.step), grey.data};
  const std::unique_ptr<zarray_t, void (*)(zarray_t*)> found(
      apriltag_detector_detect(detector.get(), &image), apriltag_detections_destroy);
  std::vector<ReadTag> tags;
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, &detection);
    ReadTag tag{detection->id, detection->hamming, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      // AprilTag's (0.5, 0.5) is the centre of the top left pixel, ours is (0, 0).
      tag.corners[k] = {detection->p[k][0] - 0.5, detection->p[k][1] - 0.5};
    }
    tags.push_back(tag);
  }
  return tags;
}

}  // namespace vinebench::test
