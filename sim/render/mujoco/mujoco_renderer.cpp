// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/mujoco/mujoco_renderer.h"

#ifdef VINEBENCH_HAS_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#elif defined(VINEBENCH_HAS_OSMESA)
#include <GL/osmesa.h>
#endif

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "core/util/error.h"
#include "sim/render/mujoco/mujoco_scene.h"

namespace vinebench::sim {
namespace {

constexpr float kNear = 0.05f;  // m
constexpr float kFar = 1000;    // m

// MuJoCo draws with OpenGL's compatibility profile, through EGL's functions wherever EGL is loaded
// and through OSMesa's otherwise. The software renderer below is the same.
#ifdef VINEBENCH_HAS_EGL

class CompatibilityContext {
 public:
  static constexpr const char* kPlatform = "EGL (surfaceless)";
  CompatibilityContext()
      : display_(
            eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)) {
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) {
      fail("MuJoCo's renderer: EGL has no surfaceless platform");
    }
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                       EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display_, wanted.data(), &config, 1, &count);
    eglBindAPI(EGL_OPENGL_API);
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) fail("MuJoCo's renderer: EGL gives no compatibility context");
  }
  ~CompatibilityContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  CompatibilityContext(const CompatibilityContext&) = delete;
  CompatibilityContext& operator=(const CompatibilityContext&) = delete;
  void make_current() {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      fail("MuJoCo's renderer: EGL cannot make its context current");
    }
  }

 private:
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

#elif defined(VINEBENCH_HAS_OSMESA)

class CompatibilityContext {
 public:
  static constexpr const char* kPlatform = "OSMesa";
  CompatibilityContext() {
    const std::array<int, 9> attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_DEPTH_BITS,
                                        24,
                                        OSMESA_STENCIL_BITS,
                                        8,
                                        OSMESA_PROFILE,
                                        OSMESA_COMPAT_PROFILE,
                                        0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr) fail("MuJoCo's renderer: OSMesa gives no compatibility context");
  }
  ~CompatibilityContext() { OSMesaDestroyContext(context_); }
  CompatibilityContext(const CompatibilityContext&) = delete;
  CompatibilityContext& operator=(const CompatibilityContext&) = delete;
  void make_current() {
    if (!OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
      fail("MuJoCo's renderer: OSMesa cannot make its context current");
    }
  }

 private:
  static constexpr int kSide = 4;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, 4 * kSide * kSide> window_{};  // never drawn to
};

#else

class CompatibilityContext {
 public:
  static constexpr const char* kPlatform = "none";
  void make_current() { fail("MuJoCo's renderer: this build has neither EGL nor OSMesa"); }
};

#endif

void copy(const Eigen::Vector3d& from, float* to) {
  Eigen::Map<Eigen::Vector3f>{to} = from.cast<float>();
}

/// MuJoCo's frustum is as wide as the image's shape makes it; only its middle may be set.
mjvGLCamera gl_camera(const PinholeCamera& camera, const Pose& T_world_cam) {
  mjvGLCamera view{};
  copy(T_world_cam.translation, view.pos);
  copy(T_world_cam.rotation * Eigen::Vector3d::UnitZ(), view.forward);
  copy(T_world_cam.rotation * -Eigen::Vector3d::UnitY(), view.up);
  const double top = (camera.cy + 0.5) / camera.fy;
  const double bottom = (camera.cy + 0.5 - camera.height) / camera.fy;
  const double centre = (camera.width / 2.0 - (camera.cx + 0.5)) / camera.fx;
  view.frustum_near = kNear;
  view.frustum_far = kFar;
  view.frustum_top = kNear * static_cast<float>(top);
  view.frustum_bottom = kNear * static_cast<float>(bottom);
  view.frustum_center = kNear * static_cast<float>(centre);
  return view;
}

}  // namespace

class MujocoRenderer::Impl {
 public:
  Impl(const Scene& scene, const MujocoRendererConfig& config)
      : world_(scene, config.level_distance, config.width, config.height) {
    // MuJoCo would wait for a key and end the program.
    mju_user_error = [](const char* message) { fail("MuJoCo's renderer: {}", message); };
    context_.make_current();
    mjv_defaultScene(&scene_);
    mjv_defaultOption(&option_);
    mjv_defaultCamera(&free_camera_);
    mjr_defaultContext(&gl_);
    mjv_makeScene(&world_.model(), &scene_, world_.model().ngeom + 100);
    scene_.flags[mjRND_SHADOW] = config.shadows;
    scene_.flags[mjRND_REFLECTION] = 0;
    scene_.flags[mjRND_HAZE] = 0;
    scene_.flags[mjRND_CULL_FACE] = 0;
    mjr_makeContext(&world_.model(), &gl_, mjFONTSCALE_100);
    mjr_setBuffer(mjFB_OFFSCREEN, &gl_);
    if (gl_.currentBuffer != mjFB_OFFSCREEN) fail("MuJoCo's renderer: no off-screen buffer");
  }
  ~Impl() {
    context_.make_current();
    mjr_freeContext(&gl_);
    mjv_freeScene(&scene_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  cv::Mat render(const PinholeCamera& camera, const Pose& T_world_cam) {
    context_.make_current();
    mjv_updateScene(&world_.model(), &world_.state(), &option_, nullptr, &free_camera_, mjCAT_ALL,
                    &scene_);
    if (scene_.ngeom < world_.model().ngeom) fail("MuJoCo's renderer leaves geoms out");
    scene_.camera[0] = scene_.camera[1] = gl_camera(camera, T_world_cam);
    const mjrRect all{0, 0, camera.width, camera.height};
    mjr_render(all, &scene_, &gl_);
    cv::Mat rgb(camera.height, camera.width, CV_8UC3);
    mjr_readPixels(rgb.data, nullptr, all, &gl_);
    cv::flip(rgb, rgb, 0);
    return rgb;
  }
  std::int64_t triangles() const { return world_.triangles(); }

 private:
  MujocoScene world_;
  CompatibilityContext context_;
  mjvScene scene_{};
  mjvOption option_{};
  mjvCamera free_camera_{};
  mjrContext gl_{};
};

MujocoRenderer::MujocoRenderer(const Scene& scene, const MujocoRendererConfig& config)
    : impl_(std::make_unique<Impl>(scene, config)) {}
MujocoRenderer::MujocoRenderer(MujocoRenderer&&) noexcept = default;
MujocoRenderer& MujocoRenderer::operator=(MujocoRenderer&&) noexcept = default;
MujocoRenderer::~MujocoRenderer() = default;

cv::Mat MujocoRenderer::render(const PinholeCamera& camera, const Pose& T_world_cam) {
  return impl_->render(camera, T_world_cam);
}

std::int64_t MujocoRenderer::triangles() const {
  return impl_->triangles();
}

std::string MujocoRenderer::platform() {
  return CompatibilityContext::kPlatform;
}

}  // namespace vinebench::sim
