// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/lens.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr int kLargestView = 8192;  // pixels a side
constexpr int kMargin = 2;          // pixels around the visible area
constexpr double kMostStretch = 1.5;

/// The undistorted point of the plane z = 1 for each pixel, CV_64FC2.
cv::Mat seen_points(const PinholeCamera& camera) {
  cv::Mat points(camera.height, camera.width, CV_64FC2);
  for (int y = 0; y < camera.height; ++y) {
    auto* row = points.ptr<cv::Vec2d>(y);
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = camera.unproject({x, y});
      // Written so that NaN is an error.
      if (!((camera.project(ray) - Eigen::Vector2d(x, y)).norm() < 1e-6)) {
        fail(
            "lens: the distortion ({}) folds over at pixel ({}, {}), expected one that grows "
            "steadily "
            "to the image's corners, less than 89.5 degrees from the axis",
            fmt::join(camera.coefficients(), ", "), x, y);
      }
      row[x] = {ray.x(), ray.y()};
    }
  }
  return points;
}

/// Maximum magnification of the lens against a pinhole of its focal length.
double magnification(const PinholeCamera& camera, const cv::Mat& points) {
  double most = 1;
  for (int y = 1; y < points.rows; y += 7) {
    for (int x = 1; x < points.cols; x += 7) {
      const cv::Vec2d here = points.at<cv::Vec2d>(y, x);
      const cv::Vec2d left = points.at<cv::Vec2d>(y, x - 1);
      const cv::Vec2d above = points.at<cv::Vec2d>(y - 1, x);
      most = std::max(
          {most, 1 / (camera.fx * (here[0] - left[0])), 1 / (camera.fy * (here[1] - above[1]))});
    }
  }
  return std::min(most, kMostStretch);
}

PinholeCamera covering_view(const PinholeCamera& camera, const cv::Mat& points) {
  const double stretch = magnification(camera, points);
  cv::Mat axes[2];
  cv::split(points, axes);
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
  cv::minMaxLoc(axes[0], &x_min, &x_max);
  cv::minMaxLoc(axes[1], &y_min, &y_max);
  PinholeCamera view;
  view.fx = camera.fx * stretch;
  view.fy = camera.fy * stretch;
  const double width = std::ceil(view.fx * (x_max - x_min)) + 1 + 2 * kMargin;
  const double height = std::ceil(view.fy * (y_max - y_min)) + 1 + 2 * kMargin;
  if (!(width <= kLargestView && height <= kLargestView)) {
    fail("lens: the distortion requires a view of {} x {} pixels, expected at most {} a side",
         width, height, kLargestView);
  }
  view.width = static_cast<int>(width);
  view.height = static_cast<int>(height);
  view.cx = kMargin - view.fx * x_min;
  view.cy = kMargin - view.fy * y_min;
  return view;
}

/// Position of each pixel in the view, CV_32FC2.
cv::Mat places_in(const PinholeCamera& view, const cv::Mat& points) {
  cv::Mat places(points.size(), CV_32FC2);
  for (int y = 0; y < points.rows; ++y) {
    for (int x = 0; x < points.cols; ++x) {
      const cv::Vec2d& p = points.at<cv::Vec2d>(y, x);
      places.at<cv::Vec2f>(y, x) = {static_cast<float>(view.fx * p[0] + view.cx),
                                    static_cast<float>(view.fy * p[1] + view.cy)};
    }
  }
  return places;
}

/// A view's rows from `top`, as a separate camera.
PinholeCamera crop_rows(PinholeCamera view, int top, int rows) {
  view.cy -= top;
  view.height = rows;
  return view;
}

void add_map(LensBand& band, const PinholeCamera& whole, const cv::Mat& places) {
  cv::Mat part = places.rowRange(band.top, band.top + band.rows).clone();
  cv::Mat axes[2];
  cv::split(part, axes);
  double low = 0, high = 0;
  cv::minMaxLoc(axes[1], &low, &high);
  const int top = std::clamp(static_cast<int>(std::floor(low)) - 1, 0, whole.height - 1);
  const int bottom = std::clamp(static_cast<int>(std::ceil(high)) + 2, top + 1, whole.height);
  band.view = crop_rows(whole, top, bottom - top);
  part -= cv::Scalar(0, top);
  cv::convertMaps(part, cv::noArray(), band.map, band.map_fraction, CV_16SC2);
  cv::Mat none;
  cv::convertMaps(part, cv::noArray(), band.map_nearest, none, CV_16SC2, true);
}

}  // namespace

cv::Mat LensBand::resample(const cv::Mat& image, bool nearest) const {
  if (map.empty() || image.empty()) return image;
  cv::Mat rows_seen;
  // With fractions, OpenCV 4.6 does not select the nearest pixel.
  if (nearest) {
    cv::remap(image, rows_seen, map_nearest, {}, cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  } else {
    cv::remap(image, rows_seen, map, map_fraction, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  }
  return rows_seen;
}

std::vector<LensBand> make_lens_bands(const PinholeCamera& camera, int count) {
  count = std::clamp(count, 1, camera.height);
  PinholeCamera whole = camera;
  cv::Mat places;
  if (camera.has_distortion()) {
    const cv::Mat points = seen_points(camera);
    whole = covering_view(camera, points);
    places = places_in(whole, points);
  }
  std::vector<LensBand> bands;
  for (int i = 0; i < count; ++i) {
    LensBand band;
    band.top = camera.height * i / count;
    band.rows = camera.height * (i + 1) / count - band.top;
    if (places.empty()) {
      band.view = count == 1 ? camera : crop_rows(camera, band.top, band.rows);
    } else {
      add_map(band, whole, places);
    }
    bands.push_back(std::move(band));
  }
  return bands;
}

}  // namespace vinebench::sim
