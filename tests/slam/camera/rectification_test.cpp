// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/rectification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/util/error.h"
#include "slam/front_end.h"
#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

constexpr double kWall = 1.5;  // m ahead of the body

PinholeCamera lens(double fx, double fy, double cx, double cy) {
  return {.width = 376, .height = 240, .fx = fx, .fy = fy, .cx = cx, .cy = cy};
}

/// A pair like EuRoC's at half size: barrel distortion, different lenses, cameras rotated by some
/// degrees.
Rig raw_rig() {
  Rig rig;
  rig.name = "raw";
  PinholeCamera left = lens(229.3, 228.6, 183.6, 124.2);
  left.distortion = {-0.283, 0.0739, 0.00019, 0.0000176};
  PinholeCamera right = lens(228.8, 227.5, 189.5, 128.0);
  right.distortion = {-0.2837, 0.0745, -0.0001, -0.0000355};
  rig.cameras = {{"left", left, Rig::mount({0, 0.055, 0}, {0.015, 0.01, -0.02})},
                 {"right", right, Rig::mount({0.003, -0.055, 0.002}, {-0.012, -0.008, 0.015})}};
  rig.stereo_pairs = {{"front", 0, 1}};
  return rig;
}

/// The same pose with ideal, rectified cameras.
Rig ideal_rig() {
  Rig rig = raw_rig();
  for (std::size_t i = 0; i < 2; ++i) {
    rig.cameras[i].model = lens(229, 229, 187.5, 119.5);
    rig.cameras[i].T_body_cam = Rig::mount({0, i == 0 ? 0.055 : -0.055, 0}, {0, 0, 0});
  }
  return rig;
}

/// The wall x = kWall of the body frame, seen by a camera: ray-traced, so that distortion and
/// rotation are exact. One texture cell is about as many pixels as in the other tests.
cv::Mat view_of_wall(const RigCamera& camera) {
  const SyntheticTexture texture(5);
  return render_image(camera.model.width, camera.model.height, [&](double x, double y) {
    const Eigen::Vector3d ray = camera.T_body_cam.rotation * camera.model.unproject({x, y});
    const Eigen::Vector3d origin = camera.T_body_cam.translation;
    const Eigen::Vector3d p = origin + ray * ((kWall - origin.x()) / ray.x());
    return texture(150 * p.y(), 150 * p.z());
  });
}

std::shared_ptr<FrameFeatures> features_of(const Rig& rig, const StereoRig& used) {
  Frame frame;
  for (const RigCamera& camera : rig.cameras) frame.images.push_back(view_of_wall(camera));
  FrontEndSettings config;
  config.features.features = 400;
  WorkerPool pool(1);
  StageTimes times;
  return FrontEnd(config, used, {}, pool).process(frame, times);
}

/// Distance of each stereo point from the wall, m.
std::vector<double> wall_errors(const Rig& rig) {
  const StereoRig used = make_stereo_rig(rig, {});
  const auto features = features_of(rig, used);
  const StereoView& view = features->views[0];
  const RectifiedPair& camera = used.pairs[0];
  std::vector<double> errors;
  for (std::size_t i = 0; i < view.features.size(); ++i) {
    if (view.stereo[i].depth <= 0) continue;
    const Keypoint& keypoint = view.features.keypoints[i];
    const Eigen::Vector3d p_cam =
        camera.lens.unproject({keypoint.x, keypoint.y}) * static_cast<double>(view.stereo[i].depth);
    errors.push_back(std::abs((camera.T_body_cam * p_cam).x() - kWall));
  }
  std::ranges::sort(errors);
  return errors;
}

TEST(RectificationTest, ARawPairMeasuresAsAnIdealOneDoes) {
  const std::vector<double> ideal = wall_errors(ideal_rig());
  const std::vector<double> raw = wall_errors(raw_rig());
  ASSERT_GT(ideal.size(), 200u);
  EXPECT_GT(raw.size(), 0.8 * static_cast<double>(ideal.size()));
  // A depth z is off by z^2 / (f b) a pixel of disparity: 1.5^2 / (229 * 0.11) = 0.089 m. Maps are
  // fixed to 1/32 px in each camera and interpolation adds about as much again: 0.1 px at the
  // median beyond the ideal pair's error.
  EXPECT_LT(raw[raw.size() / 2], ideal[ideal.size() / 2] + 0.1 * 0.089);
  EXPECT_LT(raw[raw.size() * 9 / 10], ideal[ideal.size() * 9 / 10] + 0.3 * 0.089);
}

/// Fisheyes like TUM-VI's at half size, whose corners look behind them.
Rig fisheye_rig(LensModel model, const std::vector<double>& coefficients, double focal) {
  Rig rig = raw_rig();
  for (RigCamera& camera : rig.cameras) {
    camera.model = {.width = 256, .height = 256, .fx = focal, .fy = focal, .cx = 127, .cy = 128};
    camera.model.set_lens(model, coefficients);
  }
  return rig;
}

TEST(RectificationTest, FisheyesMeasureAsAnIdealPairDoes) {
  const double degrees_55 = 1.428;  // tangent
  const std::vector<double> ideal = wall_errors(ideal_rig());
  for (const Rig& rig :
       {fisheye_rig(LensModel::kEquidistant, {0.0035, 0.0007, -0.002, 0.0002}, 95.5),
        fisheye_rig(LensModel::kDoubleSphere, {-0.18, 0.59}, 79)}) {
    const StereoRig used = make_stereo_rig(rig, {});
    const PinholeCamera& plane = used.pairs[0].lens;
    EXPECT_FALSE(plane.has_distortion());
    // The view is narrower than the lenses, and not coarser than they are near their axes.
    EXPECT_NEAR((plane.cx + 0.5) / plane.fx, degrees_55, 0.1);
    EXPECT_NEAR(plane.fx, rig.cameras[0].model.without_distortion().fx, 10);
    const std::vector<double> errors = wall_errors(rig);
    ASSERT_GT(errors.size(), 100u);
    // 1.5^2 / (90 * 0.11) = 0.23 m a pixel of disparity; the ideal pair's is 0.089 m. The same
    // share of a pixel as of the raw pair is allowed.
    const double coarser = 0.23 / 0.089;
    EXPECT_LT(errors[errors.size() / 2], coarser * ideal[ideal.size() / 2] + 0.1 * 0.23);
  }
}

TEST(RectificationTest, PointsFallOnOneRowAtTheirDisparity) {
  const Rig rig = raw_rig();
  const Rectification pair(rig.cameras[0], rig.cameras[1], "test");
  const Pose& T_body_left = pair.T_body_left();
  const Pose T_body_right{T_body_left.rotation, rig.cameras[1].T_body_cam.translation};
  const Eigen::Vector3d offset = (T_body_left.inverse() * T_body_right).translation;
  EXPECT_LT((offset - Eigen::Vector3d(pair.baseline(), 0, 0)).norm(), 1e-12);
  EXPECT_FALSE(pair.lens().has_distortion());
  EXPECT_EQ(pair.lens().fx, pair.lens().fy);
  // The centre of a white disc on black, painted at its position in a real camera, must be mapped
  // to its position in the common camera: 5 px wide, centroid to 0.05 px.
  const Eigen::Vector3d p_body(1.2, 0.2, -0.15);
  for (int i = 0; i < 2; ++i) {
    const RigCamera& camera = rig.cameras[static_cast<std::size_t>(i)];
    const Eigen::Vector2d seen = camera.model.project(camera.T_body_cam.inverse() * p_body);
    const cv::Mat painted = render_image(376, 240, [&](double x, double y) {
      return 255 * std::exp(-(Eigen::Vector2d(x, y) - seen).squaredNorm() / (2 * 4.0));
    });
    const cv::Mat rectified = i == 0 ? pair.left(painted) : pair.right(painted);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int y = 0; y < rectified.rows; ++y) {
      for (int x = 0; x < rectified.cols; ++x) {
        sum += rectified.at<std::uint8_t>(y, x) * Eigen::Vector3d(x, y, 1);
      }
    }
    const Pose& T_body_common = i == 0 ? T_body_left : T_body_right;
    const Eigen::Vector2d expected = pair.lens().project(T_body_common.inverse() * p_body);
    EXPECT_LT((sum.head<2>() / sum.z() - expected).norm(), 0.05) << "camera " << i;
  }
}

TEST(RectificationTest, KnowsWhereAPixelIsInTheRealImage) {
  const Rig rig = raw_rig();
  const Rectification pair(rig.cameras[0], rig.cameras[1], "test");
  const Eigen::Vector3d p_body(1.2, 0.2, -0.15);
  const Eigen::Vector2d rectified = pair.lens().project(pair.T_body_left().inverse() * p_body);
  const RigCamera& left = rig.cameras[0];
  const Eigen::Vector2d real = left.model.project(left.T_body_cam.inverse() * p_body);
  // The same point by both ways: rounding alone.
  EXPECT_LT((pair.in_left_image(rectified) - real).norm(), 1e-8);
}

TEST(RectificationTest, NoFeatureWhereAImageEnds) {
  Rig rig = raw_rig();
  for (RigCamera& camera : rig.cameras) {
    camera.model = lens(229, 229, 187.5, 119.5);
    camera.model.distortion = {};
  }
  rig.cameras[0].T_body_cam = Rig::mount({0, 0.055, 0}, {0.12, 0, 0});  // rolled by 7 degrees
  rig.cameras[1].T_body_cam = Rig::mount({0, -0.055, 0}, {-0.12, 0, 0});
  const StereoRig used = make_stereo_rig(rig, {});
  const auto features = features_of(rig, used);
  const RectifiedPair& camera = used.pairs[0];
  ASSERT_GT(features->views[0].features.size(), 100u);
  for (const Keypoint& keypoint : features->views[0].features.keypoints) {
    const Eigen::Vector3d ray =
        camera.T_body_cam.rotation * camera.lens.unproject({keypoint.x, keypoint.y});
    const RigCamera& real = rig.cameras[0];
    const Eigen::Vector2d source = real.model.project(real.T_body_cam.rotation.inverse() * ray);
    // 17 px of the feature's level, less the distance transform's half pixel and a rounded pixel.
    EXPECT_TRUE(real.model.contains(source, 15)) << source.transpose();
  }
}

TEST(RectificationTest, CountsAndTagsAreOfTheRealCameras) {
  const StereoRig used = make_stereo_rig(raw_rig(), {});
  EXPECT_EQ(used.pairs[0].left_camera, 0);
  EXPECT_TRUE(used.cameras[0].model.has_distortion());
  EXPECT_EQ(make_stereo_rig(ideal_rig(), {}).pairs[0].rectification, nullptr);
}

TEST(RectificationTest, PairsThatAreNoneAreErrors) {
  const auto error = [](const std::function<void(Rig&)>& change) -> std::string {
    Rig rig = raw_rig();
    change(rig);
    try {
      make_stereo_rig(rig, {});
    } catch (const Error& thrown) {
      return thrown.what();
    }
    return "";
  };
  const auto mount = [](double y, double z, double yaw) {
    return Rig::mount({0, y, z}, {0, 0, yaw});
  };
  EXPECT_THAT(
      error([](Rig& rig) { std::swap(rig.stereo_pairs[0].left, rig.stereo_pairs[0].right); }),
      testing::HasSubstr("rig 'raw': stereo pair 'front': expected the right camera to the"));
  EXPECT_THAT(error([&](Rig& rig) { rig.cameras[1].T_body_cam = mount(0.055, -0.1, 0); }),
              testing::HasSubstr("to the right of the left camera"));  // vertical pair
  EXPECT_THAT(error([&](Rig& rig) { rig.cameras[1].T_body_cam = mount(-0.055, 0, 3); }),
              testing::HasSubstr("expected the right camera"));  // looks backwards
  EXPECT_THAT(error([](Rig& rig) {
                rig.cameras[1].T_body_cam.translation = rig.cameras[0].T_body_cam.translation;
              }),
              testing::HasSubstr("at different places"));
  EXPECT_THAT(error([](Rig& rig) {
                rig.cameras[0].model.distortion = {-3, 0, 0, 0};
              }),
              testing::HasSubstr("monotonic"));
}

}  // namespace
}  // namespace vinebench::slam
