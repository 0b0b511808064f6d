// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/match_refiner.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/slam/synthetic_texture.h"

namespace vinebench {
namespace {

/// One pair whose left eye is the body's frame turned to look along x, before a textured plane that
/// is slanted like the ground: in the eye's frame n . p = 1 with n = (0.1, 0.6, 0.8) / m.
class MatchRefinerTest : public testing::Test {
 protected:
  MatchRefinerTest() : rig_(make_rig(), OrbConfig{}), map_(1.2) {
    for (int y = 60; y < kHeight - 50; y += 30) {
      for (int x = 60; x < kWidth - 50; x += 30) places_.emplace_back(x, y);
    }
    auto seen = picture(Pose{});
    for (const Eigen::Vector2d& place : places_) add_feature(*seen, place, place.x() > 160 ? 2 : 0);
    seen->views[0].placed.assign(places_.size(), 1);
    map_.add_keyframe(seen, Pose{}, no_associations(*seen));
    for (std::size_t i = 0; i < places_.size(); ++i) {
      map_.add_landmark(on_plane(places_[i]), {0, 0, static_cast<int>(i)});
    }
    map_.keyframe(0).patches = cut_patches(*seen, map_.keyframe(0).landmarks, rig_);
  }

  static StereoRig make_rig() {
    StereoEye eye;
    eye.name = "pair";
    eye.lens = {kWidth, kHeight, 260, 260, (kWidth - 1) / 2.0, (kHeight - 1) / 2.0, {}};
    eye.baseline = 0.12;
    StereoRig rig;
    rig.pairs.push_back(eye);  // the eye's frame is the body's: T_body_cam is the identity
    return rig;
  }

  const PinholeCamera& lens() const { return rig_.eyes[0].lens; }

  double depth(const Eigen::Vector2d& pixel) const {
    return 1 / normal_.dot(lens().unproject(pixel));
  }
  Eigen::Vector3d on_plane(const Eigen::Vector2d& pixel) const {
    return lens().unproject(pixel) * depth(pixel);
  }

  /// What the eye sees from a pose: each pixel looked up where its ray meets the plane, at the
  /// pixel that shows that place from the first pose.
  std::shared_ptr<FrameFeatures> picture(const Pose& T_map_body) const {
    const SyntheticTexture texture(8);
    const auto grey = [&](double x, double y) {
      const Eigen::Vector3d ray = T_map_body.rotation * lens().unproject({x, y});
      const Eigen::Vector3d p =
          T_map_body.translation +
          ray * ((1 - normal_.dot(T_map_body.translation)) / normal_.dot(ray));
      const Eigen::Vector2d at = lens().project(p);
      return texture(at.x(), at.y());
    };
    auto frame = std::make_shared<FrameFeatures>();
    frame->views.resize(1);
    frame->pyramids.push_back(
        OrbExtractor(OrbConfig{}).pyramid(render_picture(kWidth, kHeight, grey, 1.5, 7)));
    return frame;
  }

  void add_feature(FrameFeatures& frame, const Eigen::Vector2d& pixel, int level) const {
    Keypoint keypoint;
    keypoint.x = static_cast<float>(pixel.x());
    keypoint.y = static_cast<float>(pixel.y());
    keypoint.level = level;
    const double z = depth(pixel);
    StereoMatch match;
    match.depth = static_cast<float>(z);
    match.x_right = static_cast<float>(pixel.x() - lens().fx * 0.12 / z);
    // Inverse depth is n . ray, linear in the pixel: its slope is n / f, as a share of 1 / z.
    match.slant_x = static_cast<float>(normal_.x() / lens().fx * z);
    match.slant_y = static_cast<float>(normal_.y() / lens().fy * z);
    frame.views[0].features.keypoints.push_back(keypoint);
    frame.views[0].features.descriptors.push_back({});
    frame.views[0].stereo.push_back(match);
  }

  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
  EstimatorRig rig_;
  Map map_;
  std::vector<Eigen::Vector2d> places_;
  Eigen::Vector3d normal_{0.1, 0.6, 0.8};
};

TEST_F(MatchRefinerTest, MovesMatchesToWhereTheLandmarkIs) {
  const Pose T_map_body{exp_so3({0.01, -0.02, 0}), {0.02, -0.01, 0.1}};
  auto frame = picture(T_map_body);
  Associations associations(1);
  std::vector<Eigen::Vector2d> truth;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Eigen::Vector2d pixel = lens().project(T_map_body.inverse() * on_plane(places_[i]));
    if (!lens().contains(pixel, 30)) continue;
    const int level = places_[i].x() > 160 ? 2 : 0;
    truth.push_back(pixel);
    add_feature(*frame, pixel + std::pow(1.2, level) * Eigen::Vector2d(0.6, -0.5), level);
    associations[0].push_back(static_cast<int>(i));
  }
  const float disparity =
      frame->views[0].features.keypoints[0].x - frame->views[0].stereo[0].x_right;
  refine_matches(map_, T_map_body, rig_, *frame, associations);

  int placed = 0;
  double squares = 0;
  for (std::size_t f = 0; f < truth.size(); ++f) {
    if (associations[0][f] < 0) continue;
    ++placed;
    EXPECT_TRUE(frame->views[0].is_placed(f));
    const Keypoint& keypoint = frame->views[0].features.keypoints[f];
    squares += (Eigen::Vector2d(keypoint.x, keypoint.y) - truth[f]).squaredNorm();
  }
  EXPECT_GT(placed, static_cast<int>(truth.size()) * 2 / 3);  // others have too little texture
  // Begun 0.8 px off; noise and interpolation leave less than a tenth of a pixel.
  EXPECT_LT(std::sqrt(squares / placed), 0.1);
  // The stereo partner has moved along.
  EXPECT_NEAR(frame->views[0].features.keypoints[0].x - frame->views[0].stereo[0].x_right,
              disparity, 1e-4);
}

TEST_F(MatchRefinerTest, UntiesWhatThePatchContradicts) {
  auto frame = picture(Pose{});
  Associations associations(1);
  // Every feature is tied to the landmark one row further down: the same level, another place.
  const auto row = static_cast<std::size_t>(
      std::ranges::count(places_, places_[0].y(), [](const Eigen::Vector2d& p) { return p.y(); }));
  for (std::size_t i = 0; i + row < places_.size(); ++i) {
    add_feature(*frame, places_[i], places_[i].x() > 160 ? 2 : 0);
    associations[0].push_back(static_cast<int>(i + row));
  }
  refine_matches(map_, Pose{}, rig_, *frame, associations);
  const auto kept =
      std::count_if(associations[0].begin(), associations[0].end(), [](int id) { return id >= 0; });
  EXPECT_LE(kept, static_cast<int>(associations[0].size()) / 20);
}

TEST_F(MatchRefinerTest, LeavesAFrameWithoutPicturesAlone) {
  auto frame = picture(Pose{});
  add_feature(*frame, places_[0], 0);
  frame->pyramids.clear();
  Associations associations{{0}};
  refine_matches(map_, Pose{}, rig_, *frame, associations);
  EXPECT_EQ(associations[0][0], 0);
  EXPECT_FALSE(frame->views[0].is_placed(0));
}

}  // namespace
}  // namespace vinebench
