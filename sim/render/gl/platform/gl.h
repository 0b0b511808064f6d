// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GL/glcorearb.h>

namespace vinebench::sim {

// epoxy and its like resolve through GLX or EGL and do not see OSMesa, so the renderer loads the
// few functions that it calls by itself, through whichever context there is.
#define VINEBENCH_GL_FUNCTIONS(X)                                                             \
  X(GENBUFFERS, GenBuffers)                                                                   \
  X(DELETEBUFFERS, DeleteBuffers)                                                             \
  X(BINDBUFFER, BindBuffer)                                                                   \
  X(BUFFERDATA, BufferData)                                                                   \
  X(GENTEXTURES, GenTextures)                                                                 \
  X(DELETETEXTURES, DeleteTextures)                                                           \
  X(BINDTEXTURE, BindTexture)                                                                 \
  X(ACTIVETEXTURE, ActiveTexture)                                                             \
  X(TEXIMAGE2D, TexImage2D)                                                                   \
  X(TEXPARAMETERI, TexParameteri)                                                             \
  X(TEXPARAMETERFV, TexParameterfv)                                                           \
  X(TEXPARAMETERF, TexParameterf)                                                             \
  X(GENVERTEXARRAYS, GenVertexArrays)                                                         \
  X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                   \
  X(BINDVERTEXARRAY, BindVertexArray)                                                         \
  X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                 \
  X(VERTEXATTRIBDIVISOR, VertexAttribDivisor)                                                 \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                         \
  X(GENFRAMEBUFFERS, GenFramebuffers)                                                         \
  X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                   \
  X(BINDFRAMEBUFFER, BindFramebuffer)                                                         \
  X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                               \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                         \
  X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                           \
  X(GENRENDERBUFFERS, GenRenderbuffers)                                                       \
  X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                 \
  X(BINDRENDERBUFFER, BindRenderbuffer)                                                       \
  X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                 \
  X(CREATESHADER, CreateShader)                                                               \
  X(SHADERSOURCE, ShaderSource)                                                               \
  X(COMPILESHADER, CompileShader)                                                             \
  X(GETSHADERIV, GetShaderiv)                                                                 \
  X(GETSHADERINFOLOG, GetShaderInfoLog)                                                       \
  X(DELETESHADER, DeleteShader)                                                               \
  X(CREATEPROGRAM, CreateProgram)                                                             \
  X(ATTACHSHADER, AttachShader)                                                               \
  X(LINKPROGRAM, LinkProgram)                                                                 \
  X(GETPROGRAMIV, GetProgramiv)                                                               \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                     \
  X(DELETEPROGRAM, DeleteProgram)                                                             \
  X(USEPROGRAM, UseProgram)                                                                   \
  X(GETUNIFORMLOCATION, GetUniformLocation)                                                   \
  X(UNIFORM1F, Uniform1f)                                                                     \
  X(UNIFORM2FV, Uniform2fv)                                                                   \
  X(UNIFORM3FV, Uniform3fv)                                                                   \
  X(UNIFORM4FV, Uniform4fv)                                                                   \
  X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                       \
  X(ENABLE, Enable)                                                                           \
  X(DISABLE, Disable)                                                                         \
  X(VIEWPORT, Viewport)                                                                       \
  X(CLEARCOLOR, ClearColor)                                                                   \
  X(CLEAR, Clear)                                                                             \
  X(DEPTHFUNC, DepthFunc)                                                                     \
  X(DEPTHMASK, DepthMask)                                                                     \
  X(FRONTFACE, FrontFace)                                                                     \
  X(POLYGONOFFSET, PolygonOffset)                                                             \
  X(BLENDFUNC, BlendFunc)                                                                     \
  X(DRAWBUFFER, DrawBuffer)                                                                   \
  X(READBUFFER, ReadBuffer)                                                                   \
  X(PIXELSTOREI, PixelStorei)                                                                 \
  X(READPIXELS, ReadPixels)                                                                   \
  X(DRAWARRAYS, DrawArrays)                                                                   \
  X(DRAWBUFFERS, DrawBuffers)                                                                 \
  X(DRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCE, DrawElementsInstancedBaseVertexBaseInstance) \
  X(VERTEXATTRIBIPOINTER, VertexAttribIPointer)                                               \
  X(GENSAMPLERS, GenSamplers)                                                                 \
  X(DELETESAMPLERS, DeleteSamplers)                                                           \
  X(BINDSAMPLER, BindSampler)                                                                 \
  X(SAMPLERPARAMETERI, SamplerParameteri)                                                     \
  X(BINDBUFFERBASE, BindBufferBase)                                                           \
  X(CLEARBUFFERFV, ClearBufferfv)                                                             \
  X(FLUSH, Flush)                                                                             \
  X(FENCESYNC, FenceSync)                                                                     \
  X(CLIENTWAITSYNC, ClientWaitSync)                                                           \
  X(DELETESYNC, DeleteSync)                                                                   \
  X(GETERROR, GetError)

/// The GL entry points in use: gl.Clear(...) is glClear(...). They belong to one context, which
/// must be current in the thread that calls them.
struct GlFunctions {
#define VINEBENCH_GL_MEMBER(TYPE, name) PFNGL##TYPE##PROC name = nullptr;
  VINEBENCH_GL_FUNCTIONS(VINEBENCH_GL_MEMBER)
#undef VINEBENCH_GL_MEMBER
};

}  // namespace vinebench::sim
