// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace vinebench::harness {

/// Pixels of a mask in a row, counted down the columns of an image, left column first.
struct Run {
  std::int64_t begin = 0;
  std::int64_t end = 0;  ///< the first behind it
};

/// A mask as its runs, ascending and apart from each other.
using Runs = std::vector<Run>;

/// Puts masks that do not overlap together.
Runs united(std::vector<Runs> masks);

std::int64_t area_of(const Runs& runs);

/// Box of a mask in an image of that height: x, y, width, height in whole pixels, COCO's `bbox`.
cv::Rect box_of(const Runs& runs, int height);

/// COCO's compressed run lengths, as pycocotools reads them: counts of pixels without and with the
/// mask by turns, each (from the third on less the one two before) in groups of five bits, lowest
/// first, 0x20 saying that more follow, as characters from '0' on.
std::string compress(const Runs& runs, std::int64_t pixels);

/// The other way. Throws Error for text that is none or counts other than `pixels`.
Runs decompress(const std::string& text, std::int64_t pixels);

/// The mask as an image, CV_8UC1 of 255 and 0.
cv::Mat mask_of(const Runs& runs, const cv::Size& size);

}  // namespace vinebench::harness
