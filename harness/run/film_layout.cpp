// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/film_layout.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace vinebench::harness {
namespace {

constexpr int kQuality = 72;  // of JPEG

}  // namespace

double FilmLayout::Cell::in_cell(double pixel) const {
  return std::round(10 * ((pixel + 0.5) * scale - 0.5)) / 10;
}

FilmLayout::FilmLayout(const std::vector<Camera>& cameras, int height) : height_(height) {
  for (const Camera& camera : cameras) {
    const double scale = static_cast<double>(height) / camera.height;
    const int width = std::max(1, static_cast<int>(std::lround(scale * camera.width)));
    cells_.push_back({camera.name, width_, width, scale});
    width_ += width;
  }
}

std::vector<std::uint8_t> FilmLayout::picture(const std::vector<cv::Mat>& images) const {
  cv::Mat picture(height_, width_, CV_8UC3, cv::Scalar::all(0));
  for (std::size_t i = 0; i < std::min(cells_.size(), images.size()); ++i) {
    if (images[i].empty()) continue;
    cv::Mat small;
    cv::resize(images[i], small, {cells_[i].width, height_}, 0, 0, cv::INTER_AREA);
    cv::cvtColor(small, small, images[i].channels() == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_RGB2BGR);
    small.copyTo(picture(cv::Rect(cells_[i].x, 0, cells_[i].width, height_)));
  }
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return bytes;
}

nlohmann::ordered_json FilmLayout::json() const {
  auto cells = nlohmann::ordered_json::array();
  for (const Cell& cell : cells_) {
    cells.push_back({{"camera", cell.camera}, {"x", cell.x}, {"width", cell.width}});
  }
  return {{"width", width_}, {"height", height_}, {"cells", cells}};
}

}  // namespace vinebench::harness
