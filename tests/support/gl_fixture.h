// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "sim/render/gl/platform/gl_context.h"
#include "sim/render/gl/platform/gl_objects.h"
#include "sim/render/gl/shadows/sun_view.h"

namespace vinebench::test {

/// A test with a GL context that is current.
class GlTest : public testing::Test {
 protected:
  /// The colours of an attachment, CV_8UC4, OpenGL's first row first.
  static cv::Mat read_colour(const sim::GlFunctions& gl, int width, int height,
                             int attachment = 0) {
    cv::Mat pixels(height, width, CV_8UC4);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data);
    return pixels;
  }

  /// What a fragment shader without inputs writes to an image of that size.
  cv::Mat shade(int width, int height, const std::string& fragment) const {
    const sim::GlProgram program(gl_, "test", R"(#version 420 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})",
                                 fragment);
    const sim::GlVertexArray no_vertices = sim::make_vertex_array(gl_);
    const sim::GlTarget target(gl_, width, height, false);
    target.bind();
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.Disable(GL_BLEND);
    program.use();
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    return read_colour(gl_, width, height);
  }

  /// The depths of a texture of make_depth_texture, CV_32FC1, OpenGL's first row first.
  cv::Mat depths(const sim::GlTexture& texture, int size) const {
    const sim::GlFramebuffer framebuffer = sim::make_depth_framebuffer(gl_, texture);
    cv::Mat depth(size, size, CV_32FC1);
    gl_.ReadPixels(0, 0, size, size, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data);
    return depth;
  }

  const std::unique_ptr<sim::GlContext> context_ = sim::make_gl_context();
  const sim::CurrentContext current_{*context_};
  const sim::GlFunctions& gl_ = current_.gl();
};

/// Objects of one context are not the other's: names are given from one on in each, and would
/// differ if the contexts shared them.
inline void expect_own_objects(sim::GlContext& a, sim::GlContext& b) {
  const auto new_name = [](sim::GlContext& context) {
    const sim::CurrentContext current(context);
    GLuint name = 0;
    current.gl().GenBuffers(1, &name);
    return name;
  };
  const GLuint first = new_name(a);
  EXPECT_EQ(new_name(b), first);
}

/// Whether the context has every function in use.
inline void expect_all_functions(sim::GlContext& context) {
  const sim::CurrentContext current(context);
  EXPECT_NE(context.function("glDrawElementsInstancedBaseVertexBaseInstance"), nullptr);
  EXPECT_NO_THROW(context.functions());
}

/// OpenGL 4.2 of the core profile, at least.
inline void expect_core_profile(sim::GlBackend backend) {
  const std::string version = sim::gl_version(backend);
  EXPECT_GE(std::stod(version), 4.2) << version;
  EXPECT_NE(version.find("Core"), std::string::npos) << version;
}

/// Whether the context can be taken from thread to thread and clears an image to a colour.
inline void expect_working_context(sim::GlContext& context) {
  for (int i = 0; i < 2; ++i) {
    const sim::CurrentContext current(context);
    const sim::GlFunctions& gl = current.gl();
    const sim::GlTarget target(gl, 3, 2, false);
    target.bind();
    gl.ClearColor(0.2f, 0.4f, 0.6f, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    cv::Mat pixels(2, 3, CV_8UC4);
    gl.ReadPixels(0, 0, 3, 2, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data);
    EXPECT_EQ(pixels.at<cv::Vec4b>(1, 2), cv::Vec4b(51, 102, 153, 255));  // fifths of 255
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
}

}  // namespace vinebench::test
