// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/platform/gl_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "tests/support/gl_fixture.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

class GlObjectsTest : public test::GlTest {
 protected:
  /// What a look-up at u along the middle gives of the texture.
  cv::Vec4b sampled(const GlTexture& texture, const std::string& look_up) const {
    bind_texture(gl_, 0, texture);
    return shade(1, 1,
                 R"(#version 420 core
layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 colour;
void main() { colour = )" +
                     look_up + "; }")
        .at<cv::Vec4b>(0, 0);
  }
  /// Red at the left, blue at the right.
  static cv::Mat red_blue() {
    cv::Mat rgba(1, 2, CV_8UC4, cv::Scalar(200, 0, 0, 255));
    rgba.at<cv::Vec4b>(0, 1) = {0, 0, 100, 255};
    return rgba;
  }
};

TEST_F(GlObjectsTest, AMovedNameIsDestroyedOnce) {
  GlVertexArray first = make_vertex_array(gl_);
  const GLuint name = first.get();
  GlVertexArray second(std::move(first));
  EXPECT_EQ(second.get(), name);
  EXPECT_FALSE(first);
  GlVertexArray third;
  third = std::move(second);
  EXPECT_EQ(third.get(), name);
  EXPECT_FALSE(second);
}

TEST_F(GlObjectsTest, ATextureRepeatsOrKeepsItsEdge) {
  const GlTexture repeated = make_texture(gl_, {red_blue()}, true);
  EXPECT_EQ(sampled(repeated, "texture(image, vec2(1.25, 0.5))"), cv::Vec4b(200, 0, 0, 255));
  const GlTexture clamped = make_texture(gl_, {red_blue()}, false);
  EXPECT_EQ(sampled(clamped, "texture(image, vec2(1.25, 0.5))"), cv::Vec4b(0, 0, 100, 255));
}

TEST_F(GlObjectsTest, ASmoothTextureIsInterpolated) {
  const GlTexture smooth =
      make_texture(gl_, {red_blue(), cv::Mat(1, 1, CV_8UC4, cv::Scalar::all(0))}, false);
  // The middle between two texels, of the finest level: the bias asks for a coarser one.
  const cv::Vec4b middle = sampled(smooth, "textureLod(image, vec2(0.5, 0.5), -1.0)");
  EXPECT_NEAR(middle[0], 100, 1);
  EXPECT_NEAR(middle[2], 50, 1);
  const GlTexture rough =
      make_texture(gl_, {red_blue(), cv::Mat(1, 1, CV_8UC4, cv::Scalar::all(0))}, false, false);
  EXPECT_EQ(sampled(rough, "textureLod(image, vec2(0.45, 0.5), -1.0)"), cv::Vec4b(200, 0, 0, 255));
}

TEST_F(GlObjectsTest, EveryLevelIsUploaded) {
  const cv::Mat coarse(1, 1, CV_8UC4, cv::Scalar(1, 2, 3, 4));
  const GlTexture texture = make_texture(gl_, {red_blue(), coarse}, true);
  EXPECT_EQ(sampled(texture, "texelFetch(image, ivec2(1, 0), 0)"), cv::Vec4b(0, 0, 100, 255));
  EXPECT_EQ(sampled(texture, "texelFetch(image, ivec2(0, 0), 1)"), cv::Vec4b(1, 2, 3, 4));
}

TEST_F(GlObjectsTest, ADepthTextureComparesAndIsOpenOutside) {
  const GlTexture texture = make_depth_texture(gl_, 8);
  const GlFramebuffer framebuffer = make_depth_framebuffer(gl_, texture);
  const GlProgram half(gl_, "half", R"(#version 420 core
void main() {
  // The left half, at a depth of 0.25.
  vec2 p = vec2(gl_VertexID % 2, gl_VertexID / 2) * vec2(1.0, 2.0) - 1.0;
  gl_Position = vec4(p, -0.5, 1.0);
})",
                       "#version 420 core\nvoid main() {}\n");
  const GlVertexArray no_vertices = make_vertex_array(gl_);
  gl_.Viewport(0, 0, 8, 8);
  gl_.DepthMask(GL_TRUE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  half.use();
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  const cv::Mat depth = depths(texture, 8);
  EXPECT_NEAR(depth.at<float>(4, 1), 0.25, 1e-6);
  EXPECT_EQ(depth.at<float>(4, 6), 1);

  bind_texture(gl_, 0, texture);
  const auto lit = [&](const char* place) {
    return shade(1, 1,
                 std::string(R"(#version 420 core
layout(binding = 0) uniform sampler2DShadow map;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(textureLod(map, vec3()") +
                     place + "), 0.0)); }")
        .at<cv::Vec4b>(0, 0)[0];
  };
  EXPECT_EQ(lit("0.2, 0.5, 0.2"), 255);  // nearer than what is drawn
  EXPECT_EQ(lit("0.2, 0.5, 0.3"), 0);
  EXPECT_EQ(lit("0.8, 0.5, 0.9"), 255);
  EXPECT_EQ(lit("-0.5, 0.5, 0.9"), 255);
}

TEST_F(GlObjectsTest, ATargetTakesColourAndTruth) {
  const GlTarget target(gl_, 5, 4, true);
  EXPECT_EQ(target.width(), 5);
  EXPECT_EQ(target.height(), 4);
  target.bind();
  const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, both);
  const float colour[] = {0.2f, 0.4f, 0.6f, 1}, identity[] = {0, 1, 0, 0.2f};
  gl_.ClearBufferfv(GL_COLOR, 0, colour);
  gl_.ClearBufferfv(GL_COLOR, 1, identity);
  EXPECT_EQ(read_colour(gl_, 5, 4, 0).at<cv::Vec4b>(3, 4), cv::Vec4b(51, 102, 153, 255));
  EXPECT_EQ(read_colour(gl_, 5, 4, 1).at<cv::Vec4b>(3, 4), cv::Vec4b(0, 255, 0, 51));
  EXPECT_THAT(error_of([&] { GlTarget(gl_, 1 << 20, 4, false); }),
              HasSubstr("no image of 1048576 x 4 pixels"));
}

TEST_F(GlObjectsTest, AShaderThatIsWrongIsNamedWithItsLog) {
  const std::string vertex = "#version 420 core\nvoid main() { gl_Position = vec4(0); }\n";
  EXPECT_THAT(error_of([&] {
                GlProgram(gl_, "grass", vertex, "#version 420 core\nvoid main() { nonsense = 1; }");
              }),
              AllOf(HasSubstr("shader 'grass' does not compile"), HasSubstr("nonsense")));
  const std::string asks = R"(#version 420 core
in vec3 v_missing;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(v_missing, 1.0); })";
  EXPECT_THAT(error_of([&] { GlProgram(gl_, "grass", vertex, asks); }),
              AllOf(HasSubstr("shader 'grass' does not link"), HasSubstr("v_missing")));
}

TEST_F(GlObjectsTest, AnErrorIsReportedOnceWithItsPlace) {
  EXPECT_NO_THROW(check_gl(gl_, "the start"));
  gl_.Enable(0xffff);  // GL_INVALID_ENUM
  EXPECT_THAT(error_of([&] { check_gl(gl_, "drawing a leaf"); }),
              AllOf(HasSubstr("0x500"), HasSubstr("drawing a leaf")));
  EXPECT_NO_THROW(check_gl(gl_, "the end"));
}

}  // namespace
}  // namespace vinebench::sim
