// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/painter.h"

#include <cmath>

#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// A white panel of 1 m x 1 m two metres before a camera that looks along +y.
class PainterTest : public test::GlTest {
 protected:
  PainterTest() {
    box_ = test::add_material(scene_, Label::kBox, Eigen::Vector3f::Ones());
    test::add_instance(scene_, test::add_model(scene_, test::panel(box_, 1, 1)), {0, 2, 0});
    scene_.light.sun.setZero();
    scene_.light.sky.setConstant(0.25f);
    scene_.light.bounce.setConstant(0.25f);
  }
  /// The image, its alpha the label, top row first.
  cv::Mat draw(const ViewSettings& settings = {}, int shadow_map_size = 0,
               const std::optional<Pose>& T_world_rover = std::nullopt) const {
    Painter painter(gl_, scene_, shadow_map_size);
    const GlTarget target(gl_, camera_.width, camera_.height, false);
    painter.draw(target, camera_, pose_, T_world_rover, 1, settings, {});
    return read_colour(gl_, camera_.width, camera_.height);
  }
  static cv::Vec4b at(const cv::Mat& image, int x, int y) { return image.at<cv::Vec4b>(y, x); }
  static double byte_of(double light) { return 255 * std::pow(light, 1 / 2.2); }

  Scene scene_;
  int box_ = 0;
  PinholeCamera camera_{161, 121, 100, 100, 80, 60, {}};  // the panel spans 50 x 50 pixels
  Pose pose_ = test::look_at({0, 0, 0}, {0, 1, 0});
};

TEST_F(PainterTest, AlphaIsTheLabelOfWhatIsSeen) {
  const cv::Mat image = draw();
  const int box = static_cast<int>(Label::kBox), sky = static_cast<int>(Label::kSky);
  for (const auto& [x, y, label] : std::vector<std::array<int, 3>>{{80, 60, box},
                                                                   {56, 36, box},
                                                                   {104, 84, box},
                                                                   {54, 60, sky},
                                                                   {106, 60, sky},
                                                                   {80, 34, sky},
                                                                   {80, 86, sky}}) {
    EXPECT_EQ(at(image, x, y)[3], label) << x << " " << y;
  }
}

TEST_F(PainterTest, NearThingsHideFarOnesWhateverTheirOrder) {
  const int post = test::add_material(scene_, Label::kPost, Eigen::Vector3f::Ones());
  const int model = test::add_model(scene_, test::panel(post, 0.2, 0.2));
  test::add_instance(scene_, model, {0, 1.5, 0});
  test::add_instance(scene_, model, {0.3, 2.5, 0});
  const cv::Mat image = draw();
  EXPECT_EQ(at(image, 80, 60)[3], static_cast<int>(Label::kPost));
  EXPECT_EQ(at(image, 92, 60)[3], static_cast<int>(Label::kBox));
}

TEST_F(PainterTest, LightIsTheSkysAndWhatTheSunAddsToAFaceTowardsIt) {
  EXPECT_NEAR(at(draw(), 80, 60)[0], byte_of(0.25), 1);
  scene_.light.sun = {0.5f, 0.25f, 0};
  scene_.light.towards_sun = Eigen::Vector3f(0, -1, 1).normalized();
  const cv::Vec4b lit = at(draw(), 80, 60);
  for (int c = 0; c < 3; ++c) {  // at 45 degrees
    EXPECT_NEAR(lit[c], byte_of(0.25 + static_cast<double>(scene_.light.sun[c]) * std::sqrt(0.5)),
                1);
  }
  scene_.light.towards_sun = Eigen::Vector3f(0, 1, 1).normalized();  // from behind
  EXPECT_NEAR(at(draw(), 80, 60)[0], byte_of(0.25), 1);
}

TEST_F(PainterTest, ExposureMultipliesThePanelAndTheSky) {
  const cv::Mat plain = draw(), bright = draw({.exposure = 2});
  EXPECT_NEAR(at(bright, 80, 60)[0], byte_of(0.5), 1);
  // The sky's byte is its light's 2.2nd root.
  EXPECT_NEAR(at(bright, 80, 5)[0], std::min(255.0, at(plain, 80, 5)[0] * std::exp2(1 / 2.2)), 2);
}

TEST_F(PainterTest, AShadowFallsOnWhatIsBehind) {
  scene_.light.sun.setConstant(0.5f);
  scene_.light.towards_sun = Eigen::Vector3f(-1, -1, 0).normalized();
  test::add_instance(scene_, test::add_model(scene_, test::panel(box_, 0.3, 0.3)), {-0.5, 1.5, 0});
  // The little panel's shadow lies half a metre to its right, half a metre behind it: at (0, 2).
  const double lit = byte_of(0.25 + 0.5 * std::sqrt(0.5));
  EXPECT_NEAR(at(draw({}, 512), 80, 60)[0], byte_of(0.25), 1);
  EXPECT_NEAR(at(draw({}, 512), 95, 60)[0], lit, 1);
  EXPECT_NEAR(at(draw({}, 0), 80, 60)[0], lit, 1);  // without shadows
}

TEST_F(PainterTest, HazeTurnsFarThingsIntoTheHorizon) {
  scene_.light.haze = 0.1f;
  // Of the panel's corners, all of them sqrt(4 + 0.5) m away; encoded colours are mixed.
  const double share = 1 - std::exp(-0.1 * std::sqrt(4.5));
  EXPECT_NEAR(at(draw(), 80, 60)[0],
              (1 - share) * byte_of(0.25) + share * byte_of(kSkySeen * 1.55 * 0.25), 1);
}

TEST_F(PainterTest, AWireCoversPixelsByItsShareAndOneThatIsThickTakesTheirLabel) {
  const int steel = test::add_material(scene_, Label::kWire, Eigen::Vector3f::Zero());
  // 2 mm thick 1 m ahead: 0.2 px on the middle row; black before the panel.
  scene_.wires.push_back({{-1, 1, 0}, {1, 1, 0}, 0.001f, steel});
  // 2 cm thick 10 px above it: 2 px.
  scene_.wires.push_back({{-1, 1, 0.1f}, {1, 1, 0.1f}, 0.01f, steel});
  const cv::Mat image = draw();
  EXPECT_NEAR(at(image, 80, 60)[0], 0.8 * byte_of(0.25), 2);
  EXPECT_EQ(at(image, 80, 60)[3], static_cast<int>(Label::kBox));
  EXPECT_NEAR(at(image, 80, 50)[0], 0, 2);
  EXPECT_EQ(at(image, 80, 50)[3], static_cast<int>(Label::kWire));
}

TEST_F(PainterTest, TheRoverIsDrawnWhereItStands) {
  const int rover = test::add_material(scene_, Label::kRover, Eigen::Vector3f::Ones());
  scene_.rover_model = test::add_model(scene_, test::panel(rover, 0.2, 0.2));
  EXPECT_EQ(at(draw(), 80, 60)[3], static_cast<int>(Label::kBox));
  const Pose there{Eigen::Quaterniond::Identity(), {0, 1, 0}};
  EXPECT_EQ(at(draw({}, 0, there), 80, 60)[3], static_cast<int>(Label::kRover));
}

TEST_F(PainterTest, TheTruthGoesToItsOwnTargets) {
  Painter painter(gl_, scene_, 0);
  const GlTarget target(gl_, camera_.width, camera_.height, true);
  painter.draw(target, camera_, pose_, std::nullopt, 1, {}, {.instances = true});
  const cv::Mat identity = read_colour(gl_, camera_.width, camera_.height, 1);
  EXPECT_EQ(at(identity, 80, 60), cv::Vec4b(1, 0, 0, 0));  // the first instance, no part
  EXPECT_EQ(at(identity, 5, 5), cv::Vec4b(0, 0, 0, 0));
  EXPECT_EQ(at(read_colour(gl_, camera_.width, camera_.height, 0), 80, 60)[3],
            static_cast<int>(Label::kBox));
}

TEST_F(PainterTest, TheSameViewAgainIsTheSameBytes) {
  Painter painter(gl_, scene_, 256);
  const GlTarget target(gl_, camera_.width, camera_.height, false);
  const auto draw_from = [&](const Pose& pose) {
    painter.draw(target, camera_, pose, std::nullopt, 1, {}, {});
    return read_colour(gl_, camera_.width, camera_.height);
  };
  const cv::Mat first = draw_from(pose_);
  draw_from(test::look_at({1, 0, 1}, {0, 2, 0}));
  EXPECT_EQ(cv::norm(first, draw_from(pose_), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace vinebench::sim
