// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/light_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/render/gl/scene/mip_levels.h"

namespace vinebench::sim {
namespace {

constexpr double kTexel = 0.012;      // m; finer than the shadow of a cane is sharp
constexpr double kLongestMapped = 8;  // m; of a low sun, longer ones are cut
constexpr double kMargin = 0.3;       // m of open ground round the shadows

/// Where shadows lie: the footprint of all that casts one, and of its tops cast along the sun.
Eigen::AlignedBox2d shaded_ground(const GpuScene& scene) {
  const Eigen::Vector3d sun = scene.light.towards_sun.cast<double>();
  Eigen::AlignedBox2d box;
  for (const GpuInstance& instance : scene.instances) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(instance.model)];
    if (!model.casts_shadow || model.bounds.isEmpty() || instance.moves) continue;
    const Eigen::Vector2d foot = instance.centre.head<2>();
    const double reach = instance.radius / std::max(1e-3, sun.z()) * sun.head<2>().norm();
    const Eigen::Vector2d away = sun.head<2>().norm() > 1e-6
                                     ? Eigen::Vector2d(-sun.head<2>().normalized())
                                     : Eigen::Vector2d::Zero();
    const Eigen::Vector2d around = Eigen::Vector2d::Constant(instance.radius + kMargin);
    const Eigen::Vector2d tip = foot + std::min(2 * reach, kLongestMapped) * away;
    box.extend(foot - around).extend(foot + around);
    box.extend(tip - around).extend(tip + around);
  }
  return box;
}

Material white_ground() {
  Material material;
  material.label = Label::kGround;
  return material;
}

GlFramebuffer colour_framebuffer(const GlFunctions& gl, const GlRenderbuffer& colour,
                                 const cv::Size& size) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  GlFramebuffer framebuffer(gl, name);
  gl.BindFramebuffer(GL_FRAMEBUFFER, name);
  gl.BindRenderbuffer(GL_RENDERBUFFER, colour.get());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.width, size.height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.get());
  return framebuffer;
}

/// The light where the ground lies open.
cv::Scalar open_ground(const cv::Mat& map) {
  cv::Mat grey;
  cv::cvtColor(map, grey, cv::COLOR_RGBA2GRAY);
  double brightest = 0;
  cv::minMaxLoc(grey, nullptr, &brightest);
  return cv::mean(map, grey > 0.94 * brightest);
}

/// The rim repeats for ever outside the map: there the ground lies open. Coarse levels are few
/// texels wide and would lose what they show.
std::vector<cv::Mat> levels_with_open_rim(cv::Mat map, const cv::Scalar& open) {
  constexpr int kCoarse = 16;  // texels a side
  const auto paint_rim = [&](cv::Mat& level, int width) {
    cv::rectangle(level, {0, 0}, {level.cols - 1, level.rows - 1}, open, width);
  };
  paint_rim(map, 2);
  std::vector<cv::Mat> levels = mip_levels(map, false);
  for (cv::Mat& level : levels) {
    if (std::min(level.cols, level.rows) >= kCoarse) paint_rim(level, 1);
  }
  return levels;
}

}  // namespace

LightMap::LightMap(const GpuScene& scene, const ShadowMap& shadows, MeshPrograms& programs,
                   const ViewBuffer& view, int largest) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& material) { return material.terrain; });
  Eigen::AlignedBox2d box = shaded_ground(scene);
  if (box.isEmpty() || largest == 0) {
    box = Eigen::AlignedBox2d(Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1));
  }
  const auto pixels = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / kTexel)), 8, std::max(8, largest));
  };
  const cv::Size size(pixels(box.sizes().x()), pixels(box.sizes().y()));
  const Eigen::Vector2d scale = box.sizes().cwiseInverse();
  const Eigen::Vector2d offset = -box.min().cwiseProduct(scale);
  map_from_world_ << scale.cast<float>(), offset.cast<float>();
  box_ = box;
  cv::Mat map(8, 8, CV_8UC4, cv::Scalar::all(255));
  cv::Scalar open = cv::Scalar::all(255);
  if (any) {
    map = bake(scene, shadows, programs, view, size);
    open = open_ground(map);
  }
  for (int i = 0; i < 3; ++i) open_light_[i] = static_cast<float>(std::round(open[i]) / 255);
  texture_ = make_texture(scene.gl, levels_with_open_rim(map, open), false);
}

cv::Mat LightMap::bake(const GpuScene& scene, const ShadowMap& shadows, MeshPrograms& programs,
                       const ViewBuffer& view, const cv::Size& size) const {
  const GlFunctions& gl = scene.gl;
  GLuint name = 0;
  gl.GenRenderbuffers(1, &name);
  const GlRenderbuffer colour(gl, name);
  const GlFramebuffer framebuffer = colour_framebuffer(gl, colour, size);
  gl.Viewport(0, 0, size.width, size.height);
  const PinholeCamera camera{1, 1, 1, 1, 0, 0, {}};  // the world is its camera's frame
  ViewBlock block = make_view_block(camera, Pose{}, scene.light, scene.wind, {});
  block.shadow_from_cam = shadows.map_from_world().cast<float>();
  block.light_map = map_from_world_;
  block.lens.y() = static_cast<float>(1 / kBrightest);
  view.set(block);
  bind_texture(gl, kShadowUnit, shadows.texture());
  gl.ActiveTexture(GL_TEXTURE0 + kImageUnit);
  std::vector<InstanceRow> rows;
  for (const GpuInstance& instance : scene.instances) {
    rows.push_back({instance.world_from_model.topRows<3>().cast<float>(), 0});
  }
  scene.set_instances(rows);
  gl.Disable(GL_DEPTH_TEST);
  gl.ClearColor(1, 1, 1, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  MeshShader shader;
  shader.shadows = MeshShader::Shadows::kPixels;
  shader.baking = true;
  programs.get(shader).use_for(white_ground(), shadows.texel(), Eigen::Vector3f::Ones());
  gl.Disable(GL_CULL_FACE);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(scene.instances[i].model)];
    if (model.levels.empty()) continue;
    for (const GpuPrimitive& primitive : model.levels.front().primitives) {
      if (scene.materials[static_cast<std::size_t>(primitive.material)].terrain) {
        scene.draw(primitive, 0, i, 1);
      }
    }
  }
  cv::Mat map(size, CV_8UC4);
  gl.ReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, map.data);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  return map;
}

bool LightMap::is_open(const GpuInstance& instance) const {
  return box_.exteriorDistance(Eigen::Vector2d(instance.centre.head<2>())) > instance.radius;
}

}  // namespace vinebench::sim
