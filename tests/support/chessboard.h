// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/test_scene.h"

namespace vinebench::test {

/// A chessboard of 10 x 7 squares in the plane y = 0 around the origin, to measure the image
/// positions of known points.
struct Chessboard {
  static constexpr int kColumns = 10;
  static constexpr int kRows = 7;
  static constexpr double kSquare = 0.05;  // m

  /// The board alone, in even light.
  static sim::Scene scene() {
    constexpr int kSide = 64;  // texels
    cv::Mat rgba(kRows * kSide, kColumns * kSide, CV_8UC4);
    for (int y = 0; y < rgba.rows; ++y) {
      for (int x = 0; x < rgba.cols; ++x) {
        const bool white = (x / kSide + y / kSide) % 2 == 0;
        rgba.at<cv::Vec4b>(y, x) =
            white ? cv::Vec4b(230, 230, 230, 255) : cv::Vec4b(20, 20, 20, 255);
      }
    }
    sim::Scene scene;
    const int material = add_material(scene, Label::kTag, Eigen::Vector3f::Ones(), rgba);
    add_instance(scene, add_model(scene, panel(material, kColumns * kSquare, kRows * kSquare)),
                 {0, 0, 0});
    light_evenly(scene);
    return scene;
  }

  /// Where the camera projects the inner corners, px.
  static std::vector<cv::Point2f> corners(const PinholeCamera& camera, const Pose& T_world_cam) {
    std::vector<cv::Point2f> pixels;
    for (int row = 1; row < kRows; ++row) {
      for (int column = 1; column < kColumns; ++column) {
        const Eigen::Vector3d corner((column - 0.5 * kColumns) * kSquare, 0,
                                     (0.5 * kRows - row) * kSquare);
        const Eigen::Vector2d pixel = camera.project(T_world_cam.inverse() * corner);
        EXPECT_TRUE(camera.contains(pixel, 8));
        pixels.emplace_back(pixel.x(), pixel.y());
      }
    }
    return pixels;
  }

  /// The largest distance of a detected inner corner from its projection, px.
  static double worst_corner(const cv::Mat& rgb, const PinholeCamera& camera,
                             const Pose& T_world_cam) {
    const std::vector<cv::Point2f> expected = corners(camera, T_world_cam);
    // Started off the truth, so that a missing corner is not "found" at its start.
    std::vector<cv::Point2f> found = expected;
    for (cv::Point2f& corner : found) corner += cv::Point2f(0.7f, -0.6f);
    // A symmetric blur moves no corner; without it the pixel grid causes errors of 0.1 px.
    cv::Mat grey;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    cv::GaussianBlur(grey, grey, {5, 5}, 1.0);
    cv::cornerSubPix(grey, found, {4, 4}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4});
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      worst = std::max(worst, cv::norm(found[i] - expected[i]));
    }
    return worst;
  }
};

}  // namespace vinebench::test
