// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/platform/gl_objects.h"

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

using GenerateNames = void (*)(GLsizei, GLuint*);

GLuint generate(GenerateNames generator) {
  GLuint name = 0;
  generator(1, &name);
  return name;
}

GLuint compile(const GlFunctions& gl, GLenum kind, const std::string& name,
               const std::string& source) {
  const GLuint shader = gl.CreateShader(kind);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == 0) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    fail("shader '{}' does not compile: {}", name, log);
  }
  return shader;
}

void link(const GlFunctions& gl, GLuint program, const std::string& name) {
  gl.LinkProgram(program);
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != 0) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  fail("shader '{}' does not link: {}", name, log);
}

}  // namespace

void destroy_buffer(const GlFunctions& gl, GLuint name) {
  gl.DeleteBuffers(1, &name);
}
void destroy_texture(const GlFunctions& gl, GLuint name) {
  gl.DeleteTextures(1, &name);
}
void destroy_vertex_array(const GlFunctions& gl, GLuint name) {
  gl.DeleteVertexArrays(1, &name);
}
void destroy_framebuffer(const GlFunctions& gl, GLuint name) {
  gl.DeleteFramebuffers(1, &name);
}
void destroy_renderbuffer(const GlFunctions& gl, GLuint name) {
  gl.DeleteRenderbuffers(1, &name);
}
void destroy_program(const GlFunctions& gl, GLuint name) {
  gl.DeleteProgram(name);
}

void destroy_sampler(const GlFunctions& gl, GLuint name) {
  gl.DeleteSamplers(1, &name);
}

GlBuffer make_buffer(const GlFunctions& gl, GLenum target, const void* data, std::size_t bytes) {
  GlBuffer buffer(gl, generate(gl.GenBuffers));
  gl.BindBuffer(target, buffer.get());
  gl.BufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  return buffer;
}

GlVertexArray make_vertex_array(const GlFunctions& gl) {
  GlVertexArray array(gl, generate(gl.GenVertexArrays));
  gl.BindVertexArray(array.get());
  return array;
}

GlTexture make_texture(const GlFunctions& gl, const std::vector<cv::Mat>& levels, bool repeat,
                       bool smooth, float coarser) {
  GlTexture texture(gl, generate(gl.GenTextures));
  gl.BindTexture(GL_TEXTURE_2D, texture.get());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const cv::Mat& level = levels[i];
    gl.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGBA8, level.cols, level.rows, 0,
                  GL_RGBA, GL_UNSIGNED_BYTE, level.data);
  }
  const GLint wrap = repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
  const GLint smaller = smooth ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, levels.size() > 1 ? smaller : GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
  if (smooth && levels.size() > 1) gl.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, coarser);
  return texture;
}

void bind_texture(const GlFunctions& gl, GLint unit, const GlTexture& texture) {
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl.BindTexture(GL_TEXTURE_2D, texture.get());
}

GlTexture make_depth_texture(const GlFunctions& gl, int size) {
  GlTexture texture(gl, generate(gl.GenTextures));
  gl.BindTexture(GL_TEXTURE_2D, texture.get());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size, size, 0, GL_DEPTH_COMPONENT,
                GL_FLOAT, nullptr);
  const float far_away[] = {1, 1, 1, 1};
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, far_away);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return texture;
}

GlSampler make_coarse_depth_sampler(const GlFunctions& gl) {
  GlSampler sampler(gl, generate(gl.GenSamplers));
  gl.SamplerParameteri(sampler.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.SamplerParameteri(sampler.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.SamplerParameteri(sampler.get(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.SamplerParameteri(sampler.get(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.SamplerParameteri(sampler.get(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.SamplerParameteri(sampler.get(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return sampler;
}

void vertex_attribute(const GlFunctions& gl, GLuint index, int components, std::size_t stride,
                      std::size_t offset, int divisor) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                         reinterpret_cast<const void*>(offset));
  gl.VertexAttribDivisor(index, static_cast<GLuint>(divisor));
}

void byte_attribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, 1, GL_UNSIGNED_BYTE, GL_FALSE, static_cast<GLsizei>(stride),
                         reinterpret_cast<const void*>(offset));
}

void colour_attribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, 3, GL_UNSIGNED_BYTE, GL_TRUE, static_cast<GLsizei>(stride),
                         reinterpret_cast<const void*>(offset));
}

void integer_attribute(const GlFunctions& gl, GLuint index, std::size_t stride, std::size_t offset,
                       int divisor) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribIPointer(index, 1, GL_UNSIGNED_INT, static_cast<GLsizei>(stride),
                          reinterpret_cast<const void*>(offset));
  gl.VertexAttribDivisor(index, static_cast<GLuint>(divisor));
}

GlProgram::GlProgram(const GlFunctions& gl, const std::string& name, const std::string& vertex,
                     const std::string& fragment)
    : gl_(&gl), program_(gl, gl.CreateProgram()) {
  for (const auto& [kind, source] :
       {std::pair(GL_VERTEX_SHADER, vertex), std::pair(GL_FRAGMENT_SHADER, fragment)}) {
    const GLuint shader = compile(gl, static_cast<GLenum>(kind), name, source);
    gl.AttachShader(program_.get(), shader);
    gl.DeleteShader(shader);
  }
  link(gl, program_.get(), name);
}

void GlProgram::use() const {
  gl_->UseProgram(program_.get());
}

GLint GlProgram::uniform(const char* name) const {
  return gl_->GetUniformLocation(program_.get(), name);
}

GlTarget::GlTarget(const GlFunctions& gl, int width, int height, bool truth)
    : gl_(gl), width_(width), height_(height) {
  std::vector<GLenum> formats{GL_RGBA8};
  if (truth) formats.insert(formats.end(), {GL_RGBA8, GL_RGBA16, GL_RGBA32F});
  framebuffer_ = GlFramebuffer(gl, generate(gl.GenFramebuffers));
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  for (const GLenum format : formats) {
    const auto index = static_cast<GLenum>(colours_.size());
    attach(GL_COLOR_ATTACHMENT0 + index, format,
           colours_.emplace_back(gl, generate(gl.GenRenderbuffers)));
  }
  depth_ = GlRenderbuffer(gl, generate(gl.GenRenderbuffers));
  attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, depth_);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail("renderer: OpenGL gives no image of {} x {} pixels", width, height);
  }
}

void GlTarget::attach(GLenum place, GLenum format, const GlRenderbuffer& buffer) const {
  gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer.get());
  gl_.RenderbufferStorage(GL_RENDERBUFFER, format, width_, height_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer.get());
}

void GlTarget::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl_.Viewport(0, 0, width_, height_);
}

void check_gl(const GlFunctions& gl, const char* where) {
  const GLenum error = gl.GetError();
  if (error != GL_NO_ERROR) fail("renderer: OpenGL error {:#x} in {}", error, where);
}

}  // namespace vinebench::sim
