// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "core/util/random.h"

namespace vinebench::test {

/// A ray-traced image of a printed tag36h11: each pixel is the mean of 6 x 6 samples.
class SyntheticTag {
 public:
  SyntheticTag(int id, double size) : size_(size) {
    apriltag_family_t* family = tag36h11_create();
    image_u8_t* print = apriltag_to_image(family, static_cast<uint32_t>(id));
    cells_ = cv::Mat(print->height, print->width, CV_8UC1);
    for (int y = 0; y < print->height; ++y) {
      for (int x = 0; x < print->width; ++x) {
        cells_.at<std::uint8_t>(y, x) = print->buf[y * print->stride + x];
      }
    }
    cell_ = size / family->width_at_border;
    std::free(print->buf);  // the library does not export image_u8_destroy
    std::free(print);
    tag36h11_destroy(family);
  }

  /// Corner i in the tag frame: lower left, lower right, upper right, upper left as printed.
  Eigen::Vector3d corner(std::size_t i) const {
    const double h = size_ / 2;
    return {i == 0 || i == 3 ? -h : h, i < 2 ? h : -h, 0};
  }

  /// Images are encoded by light to the power of 1 / gamma.
  void encode(double gamma) { gamma_ = gamma; }

  cv::Mat render(const PinholeCamera& camera, const Pose& T_cam_tag, double sigma = 0) const {
    cv::Mat image(camera.height, camera.width, CV_8UC1, cv::Scalar(110));
    draw(image, camera, T_cam_tag);
    const RandomStream noise(5, "tag-noise");
    for (int i = 0; sigma > 0 && i < image.rows * image.cols; ++i) {
      std::uint8_t& grey = image.at<std::uint8_t>(i / image.cols, i % image.cols);
      grey = cv::saturate_cast<std::uint8_t>(grey +
                                             sigma * noise.normal(static_cast<std::uint64_t>(i)));
    }
    return image;
  }

  void draw(cv::Mat& image, const PinholeCamera& camera, const Pose& T_cam_tag) const {
    constexpr int kSamples = 12;  // edges are quantised to twelfths of a pixel
    const Pose T_tag_cam = T_cam_tag.inverse();
    // Only pixels near the tag: within the print's circumscribed circle.
    const Eigen::Vector2d middle = camera.project(T_cam_tag.translation);
    const int reach = static_cast<int>(1.2 * size_ / T_cam_tag.translation.z() * camera.fx) + 8;
    for (int y = std::max(0, static_cast<int>(middle.y()) - reach);
         y < std::min(camera.height, static_cast<int>(middle.y()) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(middle.x()) - reach);
           x < std::min(camera.width, static_cast<int>(middle.x()) + reach); ++x) {
        double sum = 0;
        for (int s = 0; s < kSamples * kSamples; ++s) {
          const Eigen::Vector2d pixel(x - 0.5 + (s % kSamples + 0.5) / kSamples,
                                      y - 0.5 + (s / kSamples + 0.5) / kSamples);
          sum += grey(T_tag_cam.rotation * camera.unproject(pixel), T_tag_cam.translation);
        }
        image.at<std::uint8_t>(y, x) = code(sum / (kSamples * kSamples));
      }
    }
  }

 private:
  /// Of light between 0 and 255.
  std::uint8_t code(double light) const {
    return cv::saturate_cast<std::uint8_t>(gamma_ == 1 ? light
                                                       : 255 * std::pow(light / 255, 1 / gamma_));
  }

  /// Light where the ray meets the plane z = 0 of the tag frame.
  double grey(const Eigen::Vector3d& ray, const Eigen::Vector3d& camera) const {
    const double along = -camera.z() / ray.z();
    const double half = cells_.cols / 2.0;
    const int column = static_cast<int>(std::floor((camera.x() + along * ray.x()) / cell_ + half));
    const int row = static_cast<int>(std::floor((camera.y() + along * ray.y()) / cell_ + half));
    if (column < 0 || row < 0 || column >= cells_.cols || row >= cells_.rows) return 110;
    return 30 + 190 * (cells_.at<std::uint8_t>(row, column) / 255.0);
  }

  double size_;
  double gamma_ = 1;
  double cell_ = 0;
  cv::Mat cells_;
};

}  // namespace vinebench::test
