// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/frame_stream.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/util/error.h"
#include "harness/datasets/flow/flow_writer.h"
#include "harness/datasets/format/record_options.h"
#include "harness/experiment/randomisation.h"

namespace vinebench::harness {
namespace {

CapturePlan plan_of(const StreamRequest& request, const Rig& rig) {
  if (request.first < 0 || request.last < request.first || request.every < 1) {
    fail("frames: expected 0 <= first <= last, and every >= 1, found {} to {}, {}", request.first,
         request.last, request.every);
  }
  CapturePlan plan;
  plan.first = request.first;
  plan.last = request.last;
  plan.every = request.every;
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

FrameStream::FrameStream(const StreamRequest& request)
    : scenario_(load_drawn_scenario(request.scenario, request.overrides, request.randomisation,
                                    request.seed)),
      pool_(std::max(1, request.threads)),
      source_(sim::make_simulation(scenario_.simulation, static_cast<std::uint64_t>(scenario_.seed),
                                   request.machine.plant_cache, pool_,
                                   plan_of(request, load_rig(scenario_.simulation.rover.rig)))) {
  if (source_->size() == 0) fail("frames: the run has no frame from {} on", request.first);
  ahead_.emplace(*source_);
}

std::shared_ptr<const DatasetFrame> FrameStream::next() {
  std::optional<Sample> sample = ahead_->next();
  if (!sample) return nullptr;
  return std::make_shared<const DatasetFrame>(
      DatasetFrame{frames_++, std::move(sample->frame), std::move(sample->truth)});
}

ImageLabels FrameStream::things(const DatasetFrame& frame, std::size_t camera) const {
  return label_things(view_of(frame, camera, &RenderedImage::instances, "things"),
                      source_->scene());
}

FlowTruth FrameStream::flow(const DatasetFrame& from, const DatasetFrame& to,
                            std::size_t camera) const {
  for (const DatasetFrame* frame : {&from, &to})
    view_of(*frame, camera, &RenderedImage::normals, "flow");
  if (to.number != from.number + 1) {
    fail("flow: expected a frame and the next one, found {} and {}", from.number, to.number);
  }
  return flow_between(from, to, camera, true_rig().cameras.at(camera).T_body_cam);
}

}  // namespace vinebench::harness
