// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace vinebench::harness {

/// A run of a mask's pixels, counted column-wise, left column first.
struct Run {
  std::int64_t begin = 0;
  std::int64_t end = 0;  ///< one past the last
};

/// A mask as its runs, ascending and not adjacent.
using Runs = std::vector<Run>;

/// Union of disjoint masks.
Runs united(std::vector<Runs> masks);

std::int64_t area_of(const Runs& runs);

/// Box of a mask in an image of that height: x, y, width, height in whole pixels, COCO's `bbox`.
cv::Rect box_of(const Runs& runs, int height);

/// COCO's compressed RLE, as read by pycocotools: alternating counts of pixels outside and inside
/// the mask, each (from the third on minus the one two before) in groups of five bits, lowest
/// first, with 0x20 if more follow, as characters from '0' on.
std::string compress(const Runs& runs, std::int64_t pixels);

/// The inverse. Throws Error for invalid text and a total other than `pixels`.
Runs decompress(const std::string& text, std::int64_t pixels);

/// The mask as an image, CV_8UC1 of 255 and 0.
cv::Mat mask_of(const Runs& runs, const cv::Size& size);

}  // namespace vinebench::harness
