// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/view_block.h"

#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/render/gl/scene/frustum.h"

namespace vinebench::sim {
namespace {

constexpr GLuint kViewBinding = 0;
constexpr double kSwayAtOne = 0.006;  // m that a leaf at 1 m above ground sways in 1 m/s of wind

static_assert(sizeof(ViewBlock) == 5 * 64 + 10 * 16, "std140 has no padding between these");

Eigen::Vector4f extended(const Eigen::Vector3f& v, float w = 0) {
  return {v.x(), v.y(), v.z(), w};
}

void set_wind(ViewBlock& block, const Wind& wind, const ViewSettings& settings) {
  const Eigen::Vector2f sway = static_cast<float>(kSwayAtOne) * wind.speed * wind.towards;
  block.gust = {sway.x(), sway.y(), static_cast<float>(settings.time),
                static_cast<float>(settings.other_time)};
  const RandomStream random(wind.seed, "gusts");
  for (int i = 0; i < 4; ++i) {
    block.gust_phase[i] =
        static_cast<float>(random.uniform(static_cast<std::uint64_t>(i), 0, 2 * std::numbers::pi));
  }
}

}  // namespace

float encoded(double light) {
  return static_cast<float>(std::pow(std::max(0.0, light), 1 / 2.2));
}

Eigen::Vector3f horizon_light(const Light& light) {
  const Eigen::Vector3f clear = light.sky.cwiseProduct(Eigen::Vector3f(1.55f, 1.50f, 1.35f));
  return static_cast<float>(kSkySeen) * (clear + light.overcast * (1.25f * light.sky - clear));
}

ViewBlock make_view_block(const PinholeCamera& camera, const Pose& T_world_cam, const Light& light,
                          const Wind& wind, const ViewSettings& settings) {
  ViewBlock block;
  const Eigen::Matrix4d cam_from_world = T_world_cam.inverse().matrix();
  const Eigen::Matrix3f R_cam_world = cam_from_world.topLeftCorner<3, 3>().cast<float>();
  const auto exposure = static_cast<float>(settings.exposure);
  block.clip_from_cam = clip_from_cam(camera).cast<float>();
  block.cam_from_world = cam_from_world.cast<float>();
  block.world_from_cam = T_world_cam.matrix().cast<float>();
  block.towards_sun = extended(R_cam_world * light.towards_sun);
  block.up = extended(R_cam_world.col(2));
  block.sun = extended(exposure * light.sun);
  block.sky = extended(exposure * light.sky);
  block.bounce = extended(exposure * light.bounce);
  const Eigen::Vector3f haze = exposure * horizon_light(light);
  block.haze = {encoded(haze.x()), encoded(haze.y()), encoded(haze.z()), light.haze};
  block.lens = {static_cast<float>(0.5 * (camera.fx + camera.fy)), 1, encoded(settings.exposure),
                0};
  set_wind(block, wind, settings);
  return block;
}

ViewBuffer::ViewBuffer(const GlFunctions& gl)
    : gl_(gl), buffer_(make_buffer(gl, GL_UNIFORM_BUFFER, nullptr, sizeof(ViewBlock))) {}

void ViewBuffer::set(const ViewBlock& block) const {
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, buffer_.get());
  gl_.BufferData(GL_UNIFORM_BUFFER, sizeof(ViewBlock), &block, GL_STREAM_DRAW);
}

}  // namespace vinebench::sim
