// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/camera_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/render/gl/gl_renderer.h"
#include "sim/render/image_encoding.h"
#include "sim/sensors/sensors.h"
#include "tests/support/chessboard.h"
#include "tests/support/effect_camera.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;

const Light kDark{.sun = Eigen::Vector3f::Zero()};  // no sun, no glare

CameraSensorConfig off() {
  return perfect_sensors().camera;
}

/// As given, or the one at which the engine's image stays as it is.
double time_of(const CameraSensorConfig& config) {
  return config.exposure.time.value_or(config.exposure.reference_time);
}

/// A wall 2 m in front of a camera that looks along +y, black left of x = 0, white right of it.
class EdgeTest : public testing::Test {
 protected:
  static constexpr double kDistance = 2;  // m
  static constexpr double kSpeed = 0.8;   // m/s, of the body to the camera's right

  EdgeTest() : renderer_(make_scene(), {}) {}

  static Scene make_scene() {
    Scene scene;
    const int black = add_material(scene, Label::kPost, Eigen::Vector3f::Constant(0.01f));
    const int white = add_material(scene, Label::kTag, Eigen::Vector3f::Constant(0.8f));
    add_instance(scene, add_model(scene, panel(black, 4, 6)), {-2, 0, 0});
    add_instance(scene, add_model(scene, panel(white, 4, 6)), {2, 0, 0});
    light_evenly(scene);
    return scene;
  }
  /// The body is the camera: both have the camera's axes.
  static RigCamera camera() { return {"camera", {200, 160, 260, 260, 99.5, 79.5, {}}, {}}; }
  static double image_speed() { return 260 * kSpeed / kDistance; }  // px/s

  static Pose pose_at(double speed, Stamp stamp) {
    Pose pose = look_at({0, -kDistance, 0}, {0, 0, 0});
    pose.translation.x() += speed * to_seconds(stamp);
    return pose;
  }
  RenderedImage capture(const CameraSensorConfig& config, double speed = kSpeed,
                        Stamp instant = 0) {
    CameraSensor sensor(config, camera(), 0, 1, kDark);
    Shot shot;
    shot.instant = instant;
    shot.exposure = {time_of(config), config.exposure.gain_db};
    shot.request.labels = true;
    shot.request.depth = true;
    return sensor.capture(
        shot, [&](Stamp stamp) { return pose_at(speed, stamp); },
        [&](const PinholeCamera& view, const Pose& pose, const RenderRequest& request) {
          return renderer_.render(view, pose, request);
        });
  }

  /// Mean and variance (px, px^2) of the position of the edge along some rows of an image.
  static std::pair<double, double> edge(const cv::Mat& rgb, int top, int rows) {
    const cv::Mat light = to_light(rgb);
    double sum = 0, first = 0, second = 0;
    for (int y = top; y < top + rows; ++y) {
      for (int x = 0; x + 1 < light.cols; ++x) {
        const double slope = static_cast<double>(light.at<cv::Vec3f>(y, x + 1)[1]) -
                             static_cast<double>(light.at<cv::Vec3f>(y, x)[1]);
        sum += slope;
        first += slope * (x + 0.5);
        second += slope * (x + 0.5) * (x + 0.5);
      }
    }
    const double mean = first / sum;
    return {mean, second / sum - mean * mean};
  }

  GlRenderer renderer_;
};

TEST_F(EdgeTest, EverythingOffIsTheRenderedImage) {
  const RenderedImage clean = renderer_.render(camera().model, pose_at(kSpeed, 0), {true, true});
  const RenderedImage taken = capture(off());
  EXPECT_EQ(different_values(taken.rgb, clean.rgb), 0);
  EXPECT_EQ(different_values(taken.labels, clean.labels), 0);
  EXPECT_EQ(different_values(taken.depth, clean.depth), 0);
}

TEST_F(EdgeTest, TheRoverIsWhereTheCameraIsInEachSubframeAndBand) {
  CameraSensorConfig config = off();
  config.blur_subframes = 3;
  config.readout_time = 0.02;
  config.readout_bands = 4;
  CameraSensor sensor(config, camera(), 0, 1, kDark);
  int drawn = 0;
  sensor.capture(
      {}, [&](Stamp stamp) { return pose_at(kSpeed, stamp); },
      [&](const PinholeCamera& view, const Pose& pose, const RenderRequest& request) {
        ++drawn;
        EXPECT_TRUE(request.T_world_rover.has_value());
        // The body's axes are the camera's.
        EXPECT_EQ(request.T_world_rover.value_or(Pose{}).translation, pose.translation);
        return renderer_.render(view, pose, request);
      });
  EXPECT_EQ(drawn, 3 * 4);
}

// Images of motion are empty where nothing moves.
TEST_F(EdgeTest, RowsOfBandsWithoutMotionStandStill) {
  CameraSensorConfig config = off();
  config.readout_time = 0.02;
  config.readout_bands = 4;
  CameraSensor sensor(config, camera(), 0, 1, kDark);
  int drawn = 0;
  const RenderedImage image = sensor.capture(
      {}, [&](Stamp stamp) { return pose_at(0, stamp); },
      [&](const PinholeCamera& view, const Pose& pose, const RenderRequest& request) {
        RenderedImage band = renderer_.render(view, pose, request);
        if (drawn++ == 2) {
          band.motion = cv::Mat(view.height, view.width, CV_32FC3, cv::Scalar(1, 2, 3));
        }
        return band;
      });
  ASSERT_EQ(image.motion.size(), image.rgb.size());
  const int height = image.motion.rows / 4;
  const cv::Mat third = image.motion.rowRange(2 * height, 3 * height);
  const cv::Mat others[] = {image.motion.rowRange(0, 2 * height),
                            image.motion.rowRange(3 * height, 4 * height)};
  EXPECT_EQ(cv::mean(third), cv::Scalar(1, 2, 3));
  for (const cv::Mat& rows : others) EXPECT_EQ(cv::countNonZero(rows.reshape(1)), 0);
}

TEST_F(EdgeTest, BlurIsAsLongAsExposureTimesImageSpeed) {
  for (const double exposure : {0.05, 0.1}) {
    CameraSensorConfig config = off();
    config.exposure.reference_time = exposure;
    config.exposure.time = exposure;
    config.blur_subframes = 24;
    const double still = edge(capture(config, 0).rgb, 40, 80).second;
    const auto [middle, moving] = edge(capture(config).rgb, 40, 80);
    // A box of length L has the variance L^2 / 12; n instants make (1 - 1 / n^2) of it.
    const double length = std::sqrt(12 * (moving - still) / (1 - 1 / (24.0 * 24)));
    EXPECT_NEAR(length, exposure * image_speed(), 0.5);
    EXPECT_NEAR(middle, 99.5, 0.25);  // at mid-exposure the edge is on the optical axis
  }
}

TEST_F(EdgeTest, ReadoutSkewsByItsTimeTimesImageSpeed) {
  CameraSensorConfig config = off();
  config.readout_time = 0.1;
  config.readout_bands = 20;
  const cv::Mat rgb = capture(config).rgb;
  // Bands of 8 rows, the first one's middle at row 3.5 and the last one's at 155.5 of 0 to 159.
  const double top = edge(rgb, 0, 8).first;
  const double bottom = edge(rgb, 152, 8).first;
  // For later rows the camera is farther right, so the edge is farther left.
  EXPECT_NEAR((top - bottom) * 159 / 152, config.readout_time * image_speed(), 0.5);
  EXPECT_NEAR(edge(rgb, 72, 16).first, 99.5, 0.25);
}

TEST_F(EdgeTest, WithoutMotionNeitherBlurNorReadoutShow) {
  const cv::Mat clean = renderer_.render(camera().model, pose_at(0, 0), {}).rgb;
  CameraSensorConfig config = off();
  config.blur_subframes = 5;
  EXPECT_EQ(different_values(capture(config, 0).rgb, clean), 0);
  config = off();
  config.readout_time = 0.02;
  // Another crop may round an edge's pixels differently.
  EXPECT_LT(different_values(capture(config, 0).rgb, clean), 0.001 * clean.total() * 3);
}

TEST_F(EdgeTest, LabelsAndDepthAreThoseOfTheMiddle) {
  CameraSensorConfig config = off();
  config.exposure.reference_time = 0.1;
  config.exposure.time = 0.1;
  config.blur_subframes = 5;
  const RenderedImage blurred = capture(config);
  const RenderedImage clean = renderer_.render(camera().model, pose_at(kSpeed, 0), {true, true});
  EXPECT_EQ(different_values(blurred.labels, clean.labels), 0);
  EXPECT_EQ(different_values(blurred.depth, clean.depth), 0);
}

TEST_F(EdgeTest, AnEdgeOutOfFocusIsAsWideAsItsDisc) {
  CameraSensorConfig config = off();
  const double sharp = edge(capture(config, 0).rgb, 40, 80).second;
  // 0.5 * 0.05 * 260 * (1 - 1 / 2) = 3.25 px; a disc has a quarter of its radius' square as
  // variance along each axis. Its rim is drawn a pixel wide, which adds less than 0.2 px^2.
  config.depth_of_field = {0.05, 1};
  const auto [middle, blurred] = edge(capture(config, 0).rgb, 40, 80);
  EXPECT_NEAR(blurred - sharp, 3.25 * 3.25 / 4 + 0.1, 0.1);
  EXPECT_NEAR(middle, 99.5, 0.05);
  config.depth_of_field.focus = kDistance;
  EXPECT_NEAR(edge(capture(config, 0).rgb, 40, 80).second, sharp, 1e-9);
}

TEST_F(EdgeTest, DepthThatFocusNeedsIsGivenToNobodyElse) {
  CameraSensorConfig config = off();
  config.depth_of_field = {0.05, 1};
  CameraSensor sensor(config, camera(), 0, 1, kDark);
  Shot shot;
  shot.exposure = {time_of(config), 0};
  const RenderedImage image = sensor.capture(
      shot, [&](Stamp) { return pose_at(0, 0); },
      [&](const PinholeCamera& view, const Pose& pose, const RenderRequest& request) {
        EXPECT_TRUE(request.depth);
        return renderer_.render(view, pose, request);
      });
  EXPECT_TRUE(image.depth.empty());
}

TEST_F(EdgeTest, BlurChangesNoNoiseDraw) {
  CameraSensorConfig noisy;
  noisy.point_spread = 0;  // of codes in one, of light in the other
  CameraSensorConfig both = noisy;
  both.blur_subframes = 3;
  EXPECT_EQ(different_values(capture(noisy, 0).rgb, capture(both, 0).rgb), 0);
}

/// A sensor in front of a uniform wall of some code.
class WallTest : public testing::Test {
 protected:
  static constexpr int kWidth = 120;
  static constexpr int kHeight = 90;

  explicit WallTest(cv::Scalar wall = {100, 100, 100}) : wall_(wall) {}

  RigCamera camera(const char* name = "left") const {
    return {name, {kWidth, kHeight, 100, 100, 59.5, 44.5, {}}, {}};
  }
  cv::Mat capture(const CameraSensorConfig& config, double seconds = 0, const char* name = "left",
                  int index = 0) {
    CameraSensor sensor(config, camera(name), index, 1, kDark);
    Shot shot;
    shot.instant = from_seconds(seconds);
    shot.exposure = {time_of(config), config.exposure.gain_db};
    return sensor
        .capture(
            shot, [](Stamp) { return Pose{}; },
            [&](const PinholeCamera& view, const Pose&, const RenderRequest& request) {
              exposure_ = request.exposure;
              RenderedImage image;
              image.rgb = cv::Mat(view.height, view.width, CV_8UC3, wall_);
              return image;
            })
        .rgb;
  }

  cv::Scalar wall_;
  double exposure_ = 0;  ///< as last requested from the renderer
};

TEST_F(WallTest, ExposureAndGainMultiplyTheLight) {
  CameraSensorConfig config = off();
  capture(config);
  EXPECT_EQ(exposure_, 1);
  config.exposure.time = 3 * config.exposure.reference_time;
  config.exposure.gain_db = 20;
  capture(config);
  EXPECT_NEAR(exposure_, 30, 1e-9);  // three times the reference time, ten times the signal
}

TEST_F(WallTest, GainRaisesTheNoise) {
  CameraSensorConfig config;
  config.noise.read_noise = 0;
  const auto deviation = [&](double gain_db) {
    config.exposure.gain_db = gain_db;
    cv::Scalar mean, sigma;
    cv::meanStdDev(capture(config), mean, sigma);
    return sigma[0];
  };
  // A tenth of the electrons for the same code: shot noise of sqrt(10) times the share. The table
  // of 32400 draws is known to 0.4 %, rounding adds 1/12 to both variances.
  const double low = deviation(0), high = deviation(20);
  EXPECT_NEAR((high * high - 1 / 12.0) / (low * low - 1 / 12.0), 10, 0.6);
}

TEST_F(WallTest, DirtAndLeafStayOnTheirCameraAndInTheirTime) {
  CameraSensorConfig config;
  const cv::Mat plain = capture(config);
  LensDirtConfig dirt;
  dirt.scope = {{"left"}, 1, 2.0};
  LensLeafConfig leaf;
  leaf.scope = {{"right"}, 0, std::nullopt};
  config.dirt = {dirt};
  config.leaves = {leaf};
  EXPECT_EQ(different_values(capture(config, 0.999), plain), 0);
  EXPECT_GT(different_values(capture(config, 1), plain), 1000);
  EXPECT_EQ(different_values(capture(config, 2), plain), 0);
  EXPECT_GT(different_values(capture(config, 0, "right"), plain), 1000);
  EXPECT_EQ(different_values(capture(config, 0, "side"), plain), 0);
}

TEST_F(WallTest, PixelResponseIsTheSameInEveryImage) {
  CameraSensorConfig config = off();
  config.fixed_pattern.response = 0.05;
  const cv::Mat first = capture(config, 0);
  EXPECT_EQ(different_values(first, capture(config, 7)), 0);
  EXPECT_GT(different_values(first, capture(config, 0, "left", 1)), 10000);
  cv::Scalar mean, sigma;
  cv::meanStdDev(to_light(first), mean, sigma);
  EXPECT_NEAR(sigma[0] / mean[0], 0.05, 0.003);
}

/// Chessboard through a lens.
class CameraLensTest : public testing::Test {
 protected:
  RenderedImage capture(const PinholeCamera& model, const Pose& T_world_cam,
                        const CameraSensorConfig& config = off()) {
    CameraSensor sensor(config, {"camera", model, {}}, 0, 1, kDark);
    Shot shot;
    shot.exposure = {time_of(config), 0};
    shot.request.labels = true;
    return sensor.capture(
        shot, [&](Stamp) { return T_world_cam; },
        [&](const PinholeCamera& view, const Pose& pose, const RenderRequest& request) {
          return renderer_.render(view, pose, request);
        });
  }
  static PinholeCamera lens(double k1, double k2, double p1, double p2) {
    PinholeCamera camera = small_camera();
    camera.distortion = {k1, k2, p1, p2};
    return camera;
  }

  GlRenderer renderer_{Chessboard::scene(), {}};
};

/// With squares of 150 px, more than two to a texel: edges so soft that the pixel grid has no
/// influence.
TEST_F(CameraLensTest, PointsAreWhereTheCameraProjectsThem) {
  const Pose near = look_at({0.02, -0.24, 0.03}, {0.01, 0, 0}, 0.05);
  for (const std::array<double, 5>& distortion :
       {std::array<double, 5>{-0.05, 0, 0, 0}, {-0.12, 0.02, 0.001, -0.002}, {0.03, 0, 0, 0}}) {
    PinholeCamera camera = large_camera();
    camera.distortion = distortion;
    EXPECT_LT(Chessboard::worst_corner(capture(camera, near).rgb, camera, near), 0.1)
        << distortion[0];
  }
}

TEST_F(CameraLensTest, LabelsAreBentWithTheImage) {
  const PinholeCamera camera = lens(-0.12, 0.02, 0.001, -0.002);
  const Pose pose = look_at({0.02, -0.21, 0.03}, {0.01, 0, 0}, 0.05);
  const cv::Mat labels = capture(camera, pose).labels;
  int wrong = 0, seen = 0;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const Eigen::Vector3d ray = pose.rotation * camera.unproject({x, y});
      const Eigen::Vector3d p = pose.translation - ray * (pose.translation.y() / ray.y());
      const bool board = std::abs(p.x()) < 0.25 && std::abs(p.z()) < 0.175;
      seen += board;
      wrong += board != (labels.at<std::uint8_t>(y, x) == static_cast<std::uint8_t>(Label::kTag));
    }
  }
  EXPECT_GT(seen, 50000);
  // Only along the outline of about 2000 px, where a pixel's centre may be on either side.
  EXPECT_LT(wrong, 1000);
}

TEST_F(CameraLensTest, ReadoutBandsOfALensJoin) {
  const PinholeCamera camera = lens(-0.12, 0.02, 0.001, -0.002);
  const Pose pose = look_at({0.02, -0.21, 0.03}, {0.01, 0, 0}, 0.05);
  CameraSensorConfig rolling = off();
  rolling.readout_time = 0.02;
  const cv::Mat bands = capture(camera, pose, rolling).rgb;
  const cv::Mat whole = capture(camera, pose).rgb;
  cv::Mat difference;
  cv::absdiff(bands, whole, difference);
  // The view of each band is cut out of the same one; rounding of its float crop is all.
  EXPECT_LT(cv::countNonZero(cv::Mat(difference.reshape(1) > 4)), 0.002 * 3 * whole.total());
}

}  // namespace
}  // namespace vinebench::sim
