// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "harness/datasets/files/png_writer.h"

namespace vinebench::harness {

/// File format of colour and grey images. Labels are always PNG.
enum class ImageKind { kPng, kJpeg, kWebp };
inline std::vector<std::string> yaml_names(ImageKind) {
  return {"png", "jpg", "webp"};
}

/// RGB or grey, 8 bits: PNG and lossless WebP, JPEG of quality 95.
std::string encode_image(const cv::Mat& image, ImageKind kind);

/// The grey image that the SLAM core uses (from RGB or grey).
cv::Mat to_grey(const cv::Mat& image);

/// NumPy's file format (version 1.0) for an image of floats: shape (rows, columns) or (rows,
/// columns, channels), little-endian.
std::string encode_npy(const cv::Mat& image);

/// Whether a pixel has flow: it is NaN where there is none.
bool has_flow(const cv::Vec2f& flow);

/// Middlebury's .flo of a flow (CV_32FC2, px; 1e10 for NaN).
std::string encode_flo(const cv::Mat& flow);

}  // namespace vinebench::harness
