// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"
#include "slam/matching/match_refiner.h"
#include "tests/support/synthetic_texture.h"

namespace vinebench::test {

/// One pair, whose left camera's frame is the body's, in front of a textured plane with the slant
/// of the ground: in the camera's first frame n . p = 1 with n = (0.1, 0.6, 0.8) / m. The map holds
/// one keyframe at the origin with a landmark every 30 px, found on level 0 in the left half of the
/// image and on level 2 in the right one.
struct SlantedPlane {
  SlantedPlane() : rig(make_rig(), slam::OrbConfig{}), map(1.2) {
    for (int y = 60; y < kHeight - 50; y += 30) {
      for (int x = 60; x < kWidth - 50; x += 30) places.emplace_back(x, y);
    }
    auto seen = image(Pose{});
    for (const Eigen::Vector2d& place : places) add_feature(*seen, place, level_of(place));
    seen->views[0].placed.assign(places.size(), 1);
    map.add_keyframe(seen, Pose{}, slam::no_associations(*seen));
    for (std::size_t i = 0; i < places.size(); ++i) {
      map.add_landmark(on_plane(places[i]), {0, 0, static_cast<int>(i)});
    }
    map.keyframe(0).patches = slam::cut_patches(*seen, map.keyframe(0).landmarks, rig.noise);
  }

  static int level_of(const Eigen::Vector2d& place) { return place.x() > 160 ? 2 : 0; }

  const PinholeCamera& lens() const { return rig.left_cameras[0].lens; }

  double depth(const Eigen::Vector2d& pixel) const {
    return 1 / normal.dot(lens().unproject(pixel));
  }
  Eigen::Vector3d on_plane(const Eigen::Vector2d& pixel) const {
    return lens().unproject(pixel) * depth(pixel);
  }

  /// The left camera's image from a pose; no features.
  std::shared_ptr<slam::FrameFeatures> image(const Pose& T_map_body) const {
    auto frame = std::make_shared<slam::FrameFeatures>();
    frame->views.resize(1);
    frame->pyramids.push_back(pyramid(T_map_body, 7));
    return frame;
  }

  /// The images of both cameras.
  std::shared_ptr<slam::FrameFeatures> stereo_image(const Pose& T_map_body) const {
    auto frame = image(T_map_body);
    const Pose T_left_right{Eigen::Quaterniond::Identity(), {kBaseline, 0, 0}};
    frame->right_pyramids.push_back(pyramid(T_map_body * T_left_right, 9));
    return frame;
  }

  /// A feature of the first pose's image with its exact stereo match and slant.
  void add_feature(slam::FrameFeatures& frame, const Eigen::Vector2d& pixel, int level) const {
    slam::Keypoint keypoint;
    keypoint.x = static_cast<float>(pixel.x());
    keypoint.y = static_cast<float>(pixel.y());
    keypoint.level = level;
    const double z = depth(pixel);
    slam::StereoMatch match;
    match.depth = static_cast<float>(z);
    match.x_right = static_cast<float>(pixel.x() - lens().fx * kBaseline / z);
    // Inverse depth is n . ray, linear in the pixel: its slope is n / f, as a share of 1 / z.
    match.slant_x = static_cast<float>(normal.x() / lens().fx * z);
    match.slant_y = static_cast<float>(normal.y() / lens().fy * z);
    frame.views[0].features.keypoints.push_back(keypoint);
    frame.views[0].features.descriptors.push_back({});
    frame.views[0].stereo.push_back(match);
  }

  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
  static constexpr double kBaseline = 0.12;  // m
  slam::EstimatorRig rig;
  slam::Map map;
  std::vector<Eigen::Vector2d> places;  ///< px, of landmark i in the keyframe
  Eigen::Vector3d normal{0.1, 0.6, 0.8};
  std::uint64_t texture = 8;  ///< of the images taken from now on

 private:
  static slam::StereoRig make_rig() {
    slam::RectifiedPair camera;
    camera.name = "pair";
    camera.lens = {kWidth, kHeight, 260, 260, (kWidth - 1) / 2.0, (kHeight - 1) / 2.0, {}};
    camera.baseline = kBaseline;
    slam::StereoRig rig;
    rig.pairs.push_back(camera);  // T_body_cam is the identity
    return rig;
  }

  /// Each pixel is looked up at the intersection of its ray with the plane, projected into the
  /// first pose's image.
  std::vector<cv::Mat> pyramid(const Pose& T_map_cam, std::uint64_t noise) const {
    const SyntheticTexture plane(texture);
    const auto grey = [&](double x, double y) {
      const Eigen::Vector3d ray = T_map_cam.rotation * lens().unproject({x, y});
      const double range = (1 - normal.dot(T_map_cam.translation)) / normal.dot(ray);
      const Eigen::Vector2d at = lens().project(T_map_cam.translation + ray * range);
      return plane(at.x(), at.y());
    };
    return slam::OrbExtractor(slam::OrbConfig{})
        .pyramid(render_image(kWidth, kHeight, grey, 1.5, noise));
  }
};

}  // namespace vinebench::test
