// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/render_view.h"

#include "core/geometry/rig.h"
#include "core/truth/truth_images.h"
#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/labels/truth_colours.h"
#include "harness/jobs/export_view.h"
#include "harness/jobs/snapshot.h"
#include "sim/config_files.h"
#include "sim/render/factory/make_render_engine.h"
#include "sim/rover/rover.h"
#include "sim/rover/rover_asset.h"
#include "sim/sensors/effects/glare.h"

namespace vinebench::harness {
namespace {

/// The camera and where it is against the frame that --pose places.
RigCamera camera_of(const ViewRequest& request) {
  if (request.rig.empty()) {
    const std::string text = request.camera.empty() ? "752x480@263.2786" : request.camera;
    return {"camera", parse_camera(text), Rig::mount({0, 0, 0}, {0, 0, 0})};
  }
  const Rig rig = load_rig(request.rig);
  const int index = request.camera.empty() ? 0 : rig.find_camera(request.camera);
  if (index < 0) fail("{}: no camera is named '{}'", request.rig, request.camera);
  return rig.cameras[static_cast<std::size_t>(index)];
}

sim::RendererConfig renderer_config(const ViewRequest& request) {
  sim::RendererConfig config;
  sim::choose_quality(config, request.quality);
  sim::choose_backend(config, request.machine.gl_platform);
  return config;
}

sim::RenderRequest request_of(const ViewRequest& view) {
  const bool flows = !view.flow.empty() || !view.flow_visible.empty();
  const bool warps = flows || !view.disparity.empty();
  sim::RenderRequest request;
  request.labels = !view.labels.empty();
  request.depth = !view.depth.empty() || warps;
  request.instances = !view.instances.empty();
  request.normals = !view.normals.empty() || warps;
  if (!view.rover.empty()) request.T_world_rover = parse_view(view.rover);
  if (!view.rover_to.empty()) {
    request.T_world_rover_other = parse_view(view.rover_to);
    request.motion = flows;
  }
  return request;
}

void write_images(const ViewRequest& request, const RenderedImage& image) {
  write_image(request.out, image.rgb);
  const auto write = [](const std::string& file, const auto& colours) {
    if (!file.empty()) write_image(file, colours());
  };
  write(request.labels, [&] { return colour_labels(image.labels); });
  write(request.depth, [&] { return image.depth; });
  write(request.instances, [&] { return colour_instances(image.instances); });
  write(request.normals, [&] { return colour_normals(image.normals); });
}

/// What takes a second view: flow and disparity.
void write_warps(const ViewRequest& request, sim::RenderEngine& renderer, const TruthView& view,
                 const RigCamera& camera) {
  const sim::RenderRequest drawn = request_of(request);
  const auto view_from = [&](const Pose& T_world_cam, const sim::RenderRequest& asked) {
    return TruthView{camera.model, T_world_cam, renderer.render(camera.model, T_world_cam, asked)};
  };
  if (!request.flow_to.empty()) {
    sim::RenderRequest later = drawn;
    if (later.T_world_rover_other) later.T_world_rover = later.T_world_rover_other;
    const Pose there = parse_view(request.flow_to) * camera.T_body_cam;
    const FlowTruth truth = optical_flow(view, view_from(there, later));
    if (!request.flow.empty()) write_flow(request.flow, truth.flow);
    if (!request.flow_visible.empty()) write_image(request.flow_visible, truth.visible);
  }
  if (!request.disparity.empty()) {
    const Pose T_left_right{Eigen::Quaterniond::Identity(), {request.baseline, 0, 0}};
    const TruthView right = view_from(view.T_world_cam * T_left_right, drawn);
    write_image(request.disparity, kitti_disparity(disparity(view, right).disparity));
  }
}

/// The world, and the rover in it where one is asked for.
sim::Scene scene_of(const ViewRequest& request, const sim::WorldConfig& world) {
  sim::Scene scene = sim::build_scene(world, static_cast<std::uint64_t>(request.seed),
                                      request.machine.plant_cache);
  if (request.rover.empty()) return scene;
  const auto rover = sim::load_rover(request.rover_file);
  sim::add_rover(scene, rover.model);
  return scene;
}

void check(const ViewRequest& request) {
  if (request.pose.empty()) fail("render: expected --pose X,Y,Z,YAW or --turntable");
  const bool flows = !request.flow.empty() || !request.flow_visible.empty();
  if (flows == request.flow_to.empty()) {
    fail("render: expected --flow FILE or --flow-visible FILE and --flow-to X,Y,Z,YAW together");
  }
  if (request.rover.empty() && !request.rover_to.empty()) {
    fail("render: expected --rover X,Y,Z,YAW with --rover-to");
  }
}

}  // namespace

void render_view(const ViewRequest& request) {
  const sim::WorldConfig world = sim::load_world(request.world, request.overrides);
  const RigCamera camera = camera_of(request);
  if (request.turntable) {
    if (!request.export_to.empty()) fail("render: expected --pose with --export, not --turntable");
    const auto seed = static_cast<std::uint64_t>(request.seed);
    write_image(request.out, turntable(world, seed, camera.model, renderer_config(request),
                                       request.machine.plant_cache));
    return;
  }
  check(request);
  const Pose T_world_cam = parse_view(request.pose) * camera.T_body_cam;
  const sim::Scene scene = scene_of(request, world);
  const auto renderer = sim::make_render_engine(scene, renderer_config(request));
  sim::RenderRequest drawn = request_of(request);
  drawn.exposure =
      metered_exposure(*renderer, scene.light, camera.model, T_world_cam, drawn.T_world_rover);
  const TruthView view{
      camera.model, T_world_cam,
      sim::render_with_glare(*renderer, scene.light, camera.model, T_world_cam, drawn)};
  write_images(request, view.image);
  write_warps(request, *renderer, view, camera);
  if (request.export_to.empty()) return;
  export_view(request.export_to, scene,
              {camera.model, T_world_cam, renderer_config(request).lod_scale}, drawn.exposure,
              drawn.T_world_rover);
}

}  // namespace vinebench::harness
