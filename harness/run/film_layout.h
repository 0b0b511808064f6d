// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace vinebench::harness {

/// The images of all cameras side by side, made equally high: one picture of a film.
class FilmLayout {
 public:
  static constexpr int kHeight = 240;  ///< px

  struct Camera {
    std::string name;
    int width = 0, height = 0;  ///< px, of its images
  };
  /// A camera's part of a picture.
  struct Cell {
    std::string camera;
    int x = 0, width = 0;  ///< px
    double scale = 0;      ///< to its pixels from the image's

    /// A pixel coordinate of the image in the cell, to a tenth of a pixel.
    double in_cell(double pixel) const;
  };

  /// `height` of all cells, px.
  explicit FilmLayout(const std::vector<Camera>& cameras, int height = kHeight);
  const std::vector<Cell>& cells() const { return cells_; }

  /// JPEG of the images (RGB or grey, of any size), black for an empty one.
  std::vector<std::uint8_t> picture(const std::vector<cv::Mat>& images) const;

  /// `width`, `height` and `cells` of a film's index.
  nlohmann::ordered_json json() const;

 private:
  std::vector<Cell> cells_;
  int width_ = 0, height_;
};

}  // namespace vinebench::harness
