// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/read_back.h"

#include <array>

#include "sim/render/gl/scene/frustum.h"
#include "tests/support/gl_fixture.h"

namespace vinebench::sim {
namespace {

const cv::Size kPicture(37, 70);  // no multiple of the pixels and rows that are read at a time

/// A target whose pixels are functions of their place.
class ReadBackTest : public test::GlTest {
 protected:
  ReadBackTest() {
    const GlProgram program(gl_, "test", R"(#version 420 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})",
                            R"(#version 420 core
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 identity;
layout(location = 2) out vec4 facing;
layout(location = 3) out vec4 motion;
void main() {
  vec2 p = floor(gl_FragCoord.xy);
  colour = vec4(p.x, p.y, p.x + p.y, 2.0 * p.x) / 255.0;
  identity = vec4(p.x, p.y, 1.0, 2.0) / 255.0;
  facing = p.y < 3.0 ? vec4(0.0) : vec4(p.x / 37.0, 1.0 - p.y / 70.0, 0.25, 1.0);
  motion = vec4(p.x, -p.y, 0.25, 1.0);
  gl_FragDepth = p.x < 1.0 ? 1.0 : 0.5;
})");
    target_.bind();
    constexpr std::array<GLenum, 4> kTargets{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                             GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3};
    gl_.DrawBuffers(4, kTargets.data());
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LEQUAL);
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_CULL_FACE);
    gl_.Disable(GL_BLEND);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    program.use();
    gl_.BindVertexArray(no_vertices_.get());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  template <class Check>
  static void for_each_pixel(const Check& check) {
    for (int y = 0; y < kPicture.height; ++y) {
      for (int x = 0; x < kPicture.width; ++x) check(x, y);
    }
  }

  const GlTarget target_{gl_, kPicture.width, kPicture.height, true};
  const GlVertexArray no_vertices_ = make_vertex_array(gl_);
  ReadBack read_back_;
};

TEST_F(ReadBackTest, ColoursAndLabelsAreThoseOfEachPixel) {
  cv::Mat rgb, labels;
  read_back_.colours(gl_, kPicture, rgb, labels);
  for_each_pixel([&](int x, int y) {
    EXPECT_EQ(rgb.at<cv::Vec3b>(y, x), cv::Vec3b(cv::Vec3i(x, y, x + y))) << x << " " << y;
    EXPECT_EQ(labels.at<std::uint8_t>(y, x), 2 * x);
  });
}

// Depth 0.5 is where (f + n) / (f - n) - 2 f n / (f - n) / z = 0: z = 2 f n / (f + n).
TEST_F(ReadBackTest, DepthIsTheDistanceAlongTheAxis) {
  cv::Mat depth;
  read_back_.depth(gl_, kPicture, depth);
  const double z = 2 * kFarPlane * kNearPlane / (kFarPlane + kNearPlane);
  for_each_pixel([&](int x, int y) {
    EXPECT_FLOAT_EQ(depth.at<float>(y, x), x == 0 ? 0.0f : static_cast<float>(z));
  });
}

TEST_F(ReadBackTest, InstancesAreTheirNumberTimes256AndThePart) {
  cv::Mat numbers;
  read_back_.instances(gl_, kPicture, numbers);
  for_each_pixel([&](int x, int y) {
    EXPECT_EQ(numbers.at<std::int32_t>(y, x), 256 * (x + 256 * y + 65536) + 2);
  });
}

TEST_F(ReadBackTest, MotionIsThreeOfFourFloats) {
  cv::Mat motion;
  read_back_.motion(gl_, kPicture, motion);
  for_each_pixel([&](int x, int y) {
    EXPECT_EQ(motion.at<cv::Vec3f>(y, x),
              cv::Vec3f(static_cast<float>(x), static_cast<float>(-y), 0.25f));
  });
}

// Half a step of 16 bits, which span 2, is 1.53e-5.
TEST_F(ReadBackTest, NormalsGoFromMinusOneToOneAndAreZeroWhereNothingIs) {
  cv::Mat normals;
  read_back_.normals(gl_, kPicture, normals);
  for_each_pixel([&](int x, int y) {
    const auto& normal = normals.at<cv::Vec3f>(y, x);
    if (y < 3) {
      EXPECT_EQ(normal, cv::Vec3f(0, 0, 0));
      return;
    }
    const cv::Vec3f expected(2 * static_cast<float>(x) / 37 - 1, 1 - 2 * static_cast<float>(y) / 70,
                             -0.5f);
    EXPECT_LT(cv::norm(normal - expected, cv::NORM_INF), 1.6e-5);
  });
}

}  // namespace
}  // namespace vinebench::sim
