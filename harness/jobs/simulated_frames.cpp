// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/simulated_frames.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/util/error.h"
#include "harness/datasets/flow/flow_writer.h"
#include "harness/datasets/format/record_options.h"
#include "harness/experiment/randomisation.h"

namespace vinebench::harness {
namespace {

/// The requested truth images.
const TruthView& view_of(const DatasetFrame& frame, std::size_t camera,
                         const cv::Mat RenderedImage::*part, const char* truth) {
  if (camera >= frame.truth.views.size() || (frame.truth.views[camera].image.*part).empty()) {
    fail("{}: not rendered for this camera's image of frame {}; request truth \"{}\"", truth,
         frame.number, truth);
  }
  return frame.truth.views[camera];
}

}  // namespace

const std::vector<std::string>& truth_names() {
  static const std::vector<std::string> names{"depth",   "labels", "instances",
                                              "normals", "things", "flow"};
  return names;
}

CapturePlan plan_of(const FramesRequest& request, const Rig& rig) {
  CapturePlan plan;
  const auto wants = [&](const char* name) { return std::ranges::count(request.truth, name) > 0; };
  for (const std::string& name : request.truth) {
    if (std::ranges::count(truth_names(), name) > 0) continue;
    fail("truth: unknown '{}', expected some of {}", name, fmt::join(truth_names(), ", "));
  }
  plan.labels = wants("labels") || wants("things") || wants("flow");
  plan.depth = wants("depth") || wants("flow");
  plan.instances = wants("instances") || wants("things");
  plan.normals = wants("normals") || wants("flow");
  plan.motion = wants("flow");
  plan.cameras = chosen_cameras(request.cameras, rig, "cameras");
  return plan;
}

ScenarioConfig scenario_of(const FramesRequest& request) {
  ScenarioConfig scenario =
      load_drawn_scenario(request.scenario, request.overrides, request.randomisation, request.seed);
  sim::choose_backend(scenario.simulation.renderer, request.machine.gl_platform);
  return scenario;
}

ImageLabels SimulatedFrames::things(const DatasetFrame& frame, std::size_t camera) const {
  return label_things(view_of(frame, camera, &RenderedImage::instances, "things"),
                      source().scene());
}

FlowTruth SimulatedFrames::flow(const DatasetFrame& from, const DatasetFrame& to,
                                std::size_t camera) const {
  for (const DatasetFrame* frame : {&from, &to})
    view_of(*frame, camera, &RenderedImage::normals, "flow");
  if (to.number != from.number + 1) {
    fail("flow: expected a frame and the next one, found {} and {}", from.number, to.number);
  }
  return flow_between(from, to, camera, true_rig().cameras.at(camera).T_body_cam);
}

}  // namespace vinebench::harness
