// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/image_file.h"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/image_size.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

cv::Mat for_encoder(const cv::Mat& image) {
  cv::Mat out;
  switch (image.type()) {
    case CV_8UC3:
      cv::cvtColor(image, out, cv::COLOR_RGB2BGR);
      return out;
    case CV_32FC1:
      image.convertTo(out, CV_16U, 1000);
      return out;
    default:
      return image;
  }
}

}  // namespace

void write_image(const std::filesystem::path& file, const cv::Mat& image) {
  const std::string ending = file.extension().string();
  const bool lossy = ending == ".jpg" || ending == ".jpeg";
  if (!lossy && ending != ".png")
    fail("{}: expected a name that ends in .png or .jpg", file.string());
  if (lossy && image.depth() != CV_8U) fail("{}: depth needs a .png", file.string());
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, for_encoder(image), bytes,
               lossy ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 88} : std::vector<int>{});
  write_file_atomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

cv::Mat read_image(const std::filesystem::path& file, int flags) {
  return decode_image(read_file(file, FileKind::kImage), file.string(), flags);
}

cv::Mat decode_image(const std::string& bytes, const std::string& name, int flags) {
  check_image_size(bytes, name);
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(raw, flags);
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) fail("{}: not enough memory", name);
    return {};  // an invalid header
  }
}

}  // namespace vinebench::harness
