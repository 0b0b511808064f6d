// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench {

/// One rendered view. Images that were not requested are empty.
struct RenderedImage {
  cv::Mat rgb;     ///< CV_8UC3, RGB, top row first
  cv::Mat labels;  ///< CV_8UC1 of Label
  cv::Mat depth;   ///< CV_32FC1, z along the optical axis in m, 0 for sky
  /// CV_32SC1: 256 * (index into Scene::instances + 1) + Vertex::part; 0 for sky and wires. The
  /// rover counts as one more instance after the last.
  cv::Mat instances;
  /// CV_32FC3, unit, camera frame, towards the camera: of the rendered triangles, consistent with
  /// depth; of a wire, the direction to the camera. 0 for sky.
  cv::Mat normals;
  /// CV_32FC3, m, world frame: displacement of the point from `time` to `other_time`, by the wind
  /// or with the rover. May be empty where nothing in the image moves.
  cv::Mat motion;
};

/// An image and its view: depth and normals are required, motion if there is wind. The camera is an
/// ideal pinhole; images with lens distortion are compared before the distortion.
struct TruthView {
  PinholeCamera camera;
  Pose T_world_cam;
  RenderedImage image;
};

struct FlowTruth {
  /// CV_32FC2, px: from a's pixel to where its point is in b. NaN if that is not in front of camera
  /// b.
  cv::Mat flow;
  cv::Mat
      visible;  ///< CV_8UC1, 255 where the point is visible in b, 0 where it is hidden or outside
};

/// Optical flow of each pixel's centre: its point by depth, moved as RenderedImage::motion says
/// (a's `other_time` is b's `time`), projected into b. Sky is infinitely far away. Exact to the
/// depth buffer's resolution: far below 0.01 px.
///
/// A point counts as visible if the plane of b's nearest pixel (its depth and normal) passes it
/// within 0.1 % of its depth, 0.004 mm for each square metre of it (the buffer's resolution), and a
/// quarter of the depth's slope from pixel to pixel, the last at most 1 %.
///
/// Throws Error for a camera with distortion and images that lack depth or normals.
FlowTruth optical_flow(const TruthView& a, const TruthView& b);

struct DisparityTruth {
  cv::Mat disparity;  ///< CV_32FC1, px: left x - right x of the left image's pixel; 0 for sky
  cv::Mat visible;    ///< CV_8UC1, 255 where the right camera sees the point too, else 0
};

/// Disparity of a rectified pair at one instant: focal length * baseline / depth; motion has no
/// influence. Throws Error as optical_flow() does, and if the cameras differ in orientation, fx, fy
/// or cy, or are not side by side along the x axis.
DisparityTruth disparity(const TruthView& left, const TruthView& right);

}  // namespace vinebench
