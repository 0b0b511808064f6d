// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench {

/// One rendered view. What was not asked for is empty.
struct RenderedImage {
  cv::Mat rgb;     ///< CV_8UC3, RGB, top row first
  cv::Mat labels;  ///< CV_8UC1 of Label
  cv::Mat depth;   ///< CV_32FC1, z along the optical axis in m, 0 for sky
  /// CV_32SC1: 256 * (index into Scene::instances + 1) + Vertex::part; 0 for sky and wires. The
  /// rover counts as one more instance after the last.
  cv::Mat instances;
  /// CV_32FC3, unit, camera frame, towards the camera: of the triangles drawn, so that it fits
  /// depth; of a wire, its way to the camera. 0 for sky.
  cv::Mat normals;
  /// CV_32FC3, m, world frame: where this point goes from `time` to `other_time`, by the wind or
  /// with the rover.
  cv::Mat motion;
};

/// An image with what it was drawn from: depth and normals are needed, motion where the wind
/// blows. The camera is an ideal pinhole; through a lens, images are compared before it.
struct TruthView {
  PinholeCamera camera;
  Pose T_world_cam;
  RenderedImage image;
};

struct FlowTruth {
  /// CV_32FC2, px: from a's pixel to where its point is in b. NaN where that is not before camera
  /// b.
  cv::Mat flow;
  cv::Mat visible;  ///< CV_8UC1, 255 where b shows the point, 0 where it is hidden or outside
};

/// Optical flow of each pixel's centre: its point by depth, moved as RenderedImage::motion says
/// (a's `other_time` is b's `time`), projected into b. Sky is infinitely far away. Exact to the
/// depth buffer's resolution: far below 0.01 px.
///
/// A point counts as visible where the plane of what b shows at the nearest pixel (its depth and
/// normal) passes the point within 0.1 % of its depth, 0.004 mm for each square metre of it (the
/// buffer's resolution), and a quarter of the depth's slope from pixel to pixel, this at most 1 %.
///
/// Throws Error for a camera with distortion and images that lack depth or normals.
FlowTruth optical_flow(const TruthView& a, const TruthView& b);

struct DisparityTruth {
  cv::Mat disparity;  ///< CV_32FC1, px: left x - right x of the left image's pixel; 0 for sky
  cv::Mat visible;    ///< CV_8UC1, 255 where the right camera sees the point too, else 0
};

/// Disparity of a rectified pair at one instant: focal length * baseline / depth; motion is of no
/// account. Errors as of
/// optical_flow(), and where the cameras do not look the same way along a common x axis, with equal
/// fx, fy and cy.
DisparityTruth disparity(const TruthView& left, const TruthView& right);

}  // namespace vinebench
