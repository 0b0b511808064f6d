// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/mujoco/mujoco_renderer.h"

#ifdef VINEBENCH_HAS_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#elif defined(VINEBENCH_HAS_OSMESA)
#include <GL/osmesa.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/util/error.h"
#include "sim/render/camera_check.h"
#include "sim/render/gl/platform/gl_context.h"
#include "sim/render/image_encoding.h"
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
    const std::scoped_lock lock(gl_mutex());
    eglBindAPI(EGL_OPENGL_API);
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) fail("MuJoCo's renderer: EGL gives no compatibility context");
  }
  ~CompatibilityContext() {
    const std::scoped_lock lock(gl_mutex());
    eglDestroyContext(display_, context_);
  }
  CompatibilityContext(const CompatibilityContext&) = delete;
  CompatibilityContext& operator=(const CompatibilityContext&) = delete;
  void make_current() {
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      fail("MuJoCo's renderer: EGL cannot make its context current");
    }
  }
  void release() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

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
    const std::scoped_lock lock(gl_mutex());
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr) fail("MuJoCo's renderer: OSMesa gives no compatibility context");
  }
  ~CompatibilityContext() {
    const std::scoped_lock lock(gl_mutex());
    OSMesaDestroyContext(context_);
  }
  CompatibilityContext(const CompatibilityContext&) = delete;
  CompatibilityContext& operator=(const CompatibilityContext&) = delete;
  void make_current() {
    if (!OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
      fail("MuJoCo's renderer: OSMesa cannot make its context current");
    }
  }
  void release() { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }

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
  void release() {}
};

#endif

/// Makes the context current for a scope.
class Current {
 public:
  explicit Current(CompatibilityContext& context) : lock_(gl_mutex()), context_(context) {
    context_.make_current();
  }
  ~Current() { context_.release(); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  std::scoped_lock<std::recursive_mutex> lock_;
  CompatibilityContext& context_;
};

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

void check_request(const PinholeCamera& camera, const RenderRequest& request) {
  check_camera(camera);
  if (std::abs(camera.fx - camera.fy) > 1e-6 * camera.fx) {
    fail("MuJoCo's renderer: focal lengths of {} and {} px, expected equal ones", camera.fx,
         camera.fy);
  }
  for (const auto& [wanted, name] :
       {std::pair(request.normals, "normals"), std::pair(request.motion, "motion")}) {
    if (wanted) fail("MuJoCo's renderer gives no {}; expected renderer.engine: gl", name);
  }
}

/// MuJoCo's depth to z along the optical axis, m; 0 where no geom is seen.
void linearise(const cv::Mat& geoms, cv::Mat& depth) {
  for (int y = 0; y < depth.rows; ++y) {
    auto* row = depth.ptr<float>(y);
    const auto* geom = geoms.ptr<std::int32_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      row[x] = geom[x] < 0 ? 0.0f : kNear * kFar / (kFar - row[x] * (kFar - kNear));
    }
  }
}

/// What of each pixel's geom `value` gives, an image of T; 0 where there is none.
template <class T, class Value>
cv::Mat image_of(const cv::Mat& geoms, const Value& value) {
  cv::Mat image(geoms.size(), cv::traits::Type<T>::value);
  for (int y = 0; y < geoms.rows; ++y) {
    for (int x = 0; x < geoms.cols; ++x) {
      const int geom = geoms.at<std::int32_t>(y, x);
      image.at<T>(y, x) = geom < 0 ? T{} : value(geom);
    }
  }
  return image;
}

}  // namespace

class MujocoRenderer::Impl {
 public:
  Impl(const Scene& scene, const MujocoRendererConfig& config)
      : world_(scene, config.level_distance), instances_(static_cast<int>(scene.instances.size())) {
    for (const Material& material : scene.materials) labels_.push_back(material.label);
    // MuJoCo would wait for a key and end the program.
    mju_user_error = [](const char* message) { fail("MuJoCo's renderer: {}", message); };
    mjv_defaultScene(&scene_);
    mjv_defaultOption(&option_);
    mjv_defaultCamera(&free_camera_);
    mjr_defaultContext(&gl_);
    mjv_makeScene(&world_.model(), &scene_, world_.model().ngeom + 100);
    scene_.flags[mjRND_SHADOW] = config.shadows;
    scene_.flags[mjRND_REFLECTION] = 0;
    scene_.flags[mjRND_HAZE] = 0;
    scene_.flags[mjRND_CULL_FACE] = 0;
  }
  ~Impl() {
    const Current current(context_);
    mjr_freeContext(&gl_);
    mjv_freeScene(&scene_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const RenderRequest& request) {
    check_request(camera, request);
    const Current current(context_);
    make_room({camera.width, camera.height});
    world_.place_rover(request.T_world_rover);
    world_.place_movers(request.time);
    mjv_updateScene(&world_.model(), &world_.state(), &option_, nullptr, &free_camera_, mjCAT_ALL,
                    &scene_);
    if (scene_.ngeom < world_.model().ngeom) fail("MuJoCo's renderer leaves geoms out");
    scene_.camera[0] = scene_.camera[1] = gl_camera(camera, T_world_cam);
    RenderedImage image;
    image.rgb = draw(camera, request.depth ? &image.depth : nullptr);
    if (request.exposure != 1) {
      image.rgb.convertTo(image.rgb, -1, std::pow(request.exposure, 1 / kImageGamma));
    }
    if (request.labels || request.depth || request.instances) add_truth(camera, request, image);
    return image;
  }
  std::int64_t triangles() const { return world_.triangles(); }

 private:
  /// MuJoCo's buffer is made for the largest image so far.
  void make_room(const cv::Size& size) {
    if (size.width <= room_.width && size.height <= room_.height) return;
    room_ = {std::max(size.width, room_.width), std::max(size.height, room_.height)};
    world_.set_image_size(room_.width, room_.height);
    mjr_freeContext(&gl_);
    mjr_makeContext(&world_.model(), &gl_, mjFONTSCALE_100);
    mjr_setBuffer(mjFB_OFFSCREEN, &gl_);
    if (gl_.currentBuffer != mjFB_OFFSCREEN) fail("MuJoCo's renderer: no off-screen buffer");
  }

  cv::Mat draw(const PinholeCamera& camera, cv::Mat* depth) {
    const mjrRect all{0, 0, camera.width, camera.height};
    mjr_render(all, &scene_, &gl_);
    cv::Mat rgb(camera.height, camera.width, CV_8UC3);
    if (depth != nullptr) depth->create(rgb.size(), CV_32FC1);
    mjr_readPixels(rgb.data, depth == nullptr ? nullptr : depth->ptr<float>(), all, &gl_);
    cv::flip(rgb, rgb, 0);
    if (depth != nullptr) cv::flip(*depth, *depth, 0);
    return rgb;
  }

  void add_truth(const PinholeCamera& camera, const RenderRequest& request, RenderedImage& image) {
    const cv::Mat geoms = draw_geoms(camera);
    if (request.depth) linearise(geoms, image.depth);
    if (request.labels) {
      image.labels = image_of<std::uint8_t>(geoms, [&](int geom) {
        const auto material = static_cast<std::size_t>(world_.model().geom_matid[geom]);
        return static_cast<std::uint8_t>(labels_[material]);
      });
    }
    if (request.instances) {
      image.instances = image_of<std::int32_t>(geoms, [&](int geom) {
        const int instance = world_.instance_of(geom);
        return 256 * (instance == -2 ? instances_ + 1 : instance + 1);
      });
    }
  }

  /// The model's geom that each pixel shows, CV_32SC1; -1 for the sky.
  cv::Mat draw_geoms(const PinholeCamera& camera) {
    scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = 1;
    const cv::Mat codes = draw(camera, nullptr);
    scene_.flags[mjRND_SEGMENT] = scene_.flags[mjRND_IDCOLOR] = 0;
    std::vector<int> geom_of(static_cast<std::size_t>(scene_.ngeom) + 1, -1);
    for (const mjvGeom& geom : std::span(scene_.geoms, static_cast<std::size_t>(scene_.ngeom))) {
      const bool known = geom.objtype == mjOBJ_GEOM && geom.segid >= 0 && geom.segid < scene_.ngeom;
      if (known) geom_of[static_cast<std::size_t>(geom.segid) + 1] = geom.objid;
    }
    cv::Mat geoms(codes.size(), CV_32SC1);
    for (int y = 0; y < codes.rows; ++y) {
      for (int x = 0; x < codes.cols; ++x) {
        const cv::Vec3b& code = codes.at<cv::Vec3b>(y, x);
        const auto id = static_cast<std::size_t>(code[0] | code[1] << 8 | code[2] << 16);
        geoms.at<std::int32_t>(y, x) = id < geom_of.size() ? geom_of[id] : -1;
      }
    }
    return geoms;
  }

  MujocoScene world_;
  int instances_;
  std::vector<Label> labels_;  ///< by material
  CompatibilityContext context_;
  cv::Size room_{0, 0};
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

RenderedImage MujocoRenderer::render(const PinholeCamera& camera, const Pose& T_world_cam,
                                     const RenderRequest& request) {
  return impl_->render(camera, T_world_cam, request);
}

std::int64_t MujocoRenderer::triangles() const {
  return impl_->triangles();
}

std::string MujocoRenderer::platform() {
  return CompatibilityContext::kPlatform;
}

}  // namespace vinebench::sim
