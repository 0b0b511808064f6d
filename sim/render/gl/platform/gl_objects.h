// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/render/gl/platform/gl.h"

namespace vinebench::sim {

/// Owns one GL name; its context must be current when it dies.
template <void (*destroy)(const GlFunctions&, GLuint)>
class GlName {
 public:
  GlName() = default;
  GlName(const GlFunctions& gl, GLuint name) : gl_(&gl), name_(name) {}
  GlName(GlName&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) destroy(*gl_, name_);
  }
  GLuint get() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};

void destroy_buffer(const GlFunctions& gl, GLuint name);
void destroy_texture(const GlFunctions& gl, GLuint name);
void destroy_vertex_array(const GlFunctions& gl, GLuint name);
void destroy_framebuffer(const GlFunctions& gl, GLuint name);
void destroy_renderbuffer(const GlFunctions& gl, GLuint name);
void destroy_program(const GlFunctions& gl, GLuint name);
void destroy_sampler(const GlFunctions& gl, GLuint name);

using GlBuffer = GlName<destroy_buffer>;
using GlTexture = GlName<destroy_texture>;
using GlVertexArray = GlName<destroy_vertex_array>;
using GlFramebuffer = GlName<destroy_framebuffer>;
using GlRenderbuffer = GlName<destroy_renderbuffer>;
using GlSampler = GlName<destroy_sampler>;

GlBuffer make_buffer(const GlFunctions& gl, GLenum target, const void* data, std::size_t bytes);
template <class T>
GlBuffer make_buffer(const GlFunctions& gl, GLenum target, const std::vector<T>& data) {
  return make_buffer(gl, target, data.data(), data.size() * sizeof(T));
}
GlVertexArray make_vertex_array(const GlFunctions& gl);

/// A texture of the given mip levels (CV_8UC4, finest first), of which the nearest is sampled:
/// bilinearly where `smooth`, else one texel, at two thirds of the cost. `coarser` shifts the
/// choice of smooth ones: with kNoAliasing to the next coarser level, whose texels are never
/// smaller than a pixel.
inline constexpr float kNoAliasing = 0.5f;
GlTexture make_texture(const GlFunctions& gl, const std::vector<cv::Mat>& levels, bool repeat,
                       bool smooth = true, float coarser = kNoAliasing);

/// Makes it the texture of that unit, and the unit the active one.
void bind_texture(const GlFunctions& gl, GLint unit, const GlTexture& texture);

/// A depth texture to draw into and to compare with; 1 (nothing there) outside of it.
GlTexture make_depth_texture(const GlFunctions& gl, int size);

/// Compares with one texel of a depth texture in place of four.
GlSampler make_coarse_depth_sampler(const GlFunctions& gl);

/// Enables attribute `index` of `components` floats of the bound array and buffer.
void vertex_attribute(const GlFunctions& gl, GLuint index, int components, std::size_t stride,
                      std::size_t offset, int divisor = 0);

/// Enables attribute `index` of one byte, read as a float of 0 to 255.
void byte_attribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset);

/// Enables attribute `index` of three bytes, read as floats of 0 to 1.
void colour_attribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset);

/// Enables attribute `index` of one unsigned 32-bit integer.
void integer_attribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset,
                       int divisor);

/// Vertex and fragment shader, linked. Throws Error with the compiler's log.
class GlProgram {
 public:
  GlProgram() = default;
  GlProgram(const GlFunctions& gl, const std::string& name, const std::string& vertex,
            const std::string& fragment);
  void use() const;
  GLint uniform(const char* name) const;

 private:
  const GlFunctions* gl_ = nullptr;
  GlName<destroy_program> program_;
};

/// Where images are drawn: RGBA8 colour and 32-bit depth; for the truth also RGBA8 for who is
/// seen, RGBA16 for normals (from -1 at 0 to 1) and RGBA32F for motion.
class GlTarget {
 public:
  GlTarget(const GlFunctions& gl, int width, int height, bool truth);
  void bind() const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void attach(GLenum place, GLenum format, const GlRenderbuffer& buffer) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  std::vector<GlRenderbuffer> colours_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
};

/// Throws Error when GL has met one since the last call.
void check_gl(const GlFunctions& gl, const char* where);

}  // namespace vinebench::sim
