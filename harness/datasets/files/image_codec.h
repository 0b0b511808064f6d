// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "harness/datasets/files/png_writer.h"

namespace vinebench {

/// How pictures for people and networks are stored. Labels are always PNG.
enum class PictureKind { kPng, kJpeg, kWebp };
inline std::vector<std::string> yaml_names(PictureKind) {
  return {"png", "jpg", "webp"};
}

/// RGB or grey, 8 bits: PNG and WebP without loss, JPEG of quality 95.
std::string encode_picture(const cv::Mat& picture, PictureKind kind);

/// What the SLAM core sees of a picture (RGB or grey).
cv::Mat to_grey(const cv::Mat& picture);

/// NumPy's file format (version 1.0) of a picture of floats: shape (rows, columns) or (rows,
/// columns, channels), little-endian.
std::string encode_npy(const cv::Mat& picture);

/// Middlebury's .flo of a flow (CV_32FC2, px; 1e10 for NaN).
std::string encode_flo(const cv::Mat& flow);

}  // namespace vinebench
