// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/host/plugin_messages.h"

namespace vinebench::harness {
namespace {

/// A list of structs, one text of each, and that text's member, which points into this process.
template <class T>
void add_named(MessageWriter& message, const T* items, std::size_t count,
               const char* const T::*name) {
  message.add_list(items, count);
  for (std::size_t i = 0; i < count; ++i) message.add_text(items[i].*name);
}

template <class T>
void read_named(MessageReader& message, std::vector<T>& items, std::vector<std::string>& names,
                const char* T::*name) {
  items = message.read_list<T>();
  for (std::size_t i = 0; i < items.size(); ++i) names.push_back(message.read_text());
  for (std::size_t i = 0; i < items.size(); ++i) items[i].*name = names[i].c_str();
}

}  // namespace

void add_setup(MessageWriter& message, const vinebench_setup& setup) {
  message.add(setup);
  message.add_text(setup.rig);
  message.add_text(setup.settings);
  add_named(message, setup.cameras, setup.camera_count, &vinebench_camera::name);
  add_named(message, setup.stereo_pairs, setup.stereo_pair_count, &vinebench_stereo_pair::name);
  message.add_list(setup.tag_cameras, setup.tag_camera_count);
  add_named(message, setup.tags, setup.tag_count, &vinebench_tag::family);
}

ReceivedSetup::ReceivedSetup(MessageReader& message) : setup_(message.read<vinebench_setup>()) {
  rig_ = message.read_text();
  settings_ = message.read_text();
  read_named(message, cameras_, camera_names_, &vinebench_camera::name);
  read_named(message, pairs_, pair_names_, &vinebench_stereo_pair::name);
  tag_cameras_ = message.read_list<std::int32_t>();
  read_named(message, tags_, families_, &vinebench_tag::family);
  setup_.rig = rig_.c_str();
  setup_.settings = settings_.c_str();
  setup_.cameras = cameras_.data();
  setup_.stereo_pairs = pairs_.data();
  setup_.tag_cameras = tag_cameras_.data();
  setup_.tags = tags_.data();
}

void add_frame(MessageWriter& message, const vinebench_frame& frame,
               const std::vector<SharedImage>& images) {
  message.add(frame);
  message.add_list(images.data(), images.size());
  message.add_list(frame.imu, frame.imu_count);
  message.add_list(frame.wheels, frame.wheel_count);
  message.add_list(frame.image_stamps, images.size());
}

PluginFrame read_frame(MessageReader& message, const std::uint8_t* memory) {
  const auto head = message.read<vinebench_frame>();
  PluginFrame frame{.index = head.index, .stamp = head.stamp};
  for (const SharedImage& image : message.read_list<SharedImage>()) {
    const bool given = image.offset >= 0;
    frame.images.push_back(
        {given ? memory + image.offset : nullptr, image.width, image.height, image.channels,
         given ? static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels)
               : 0});
  }
  frame.imu = message.read_list<vinebench_imu_sample>();
  frame.wheels = message.read_list<vinebench_wheel_sample>();
  frame.image_stamps = message.read_list<std::int64_t>();
  return frame;
}

void add_estimate(MessageWriter& message, const PluginEstimate& estimate) {
  message.add(estimate.estimate);
  message.add_list(estimate.counts.data(), estimate.counts.size());
}

PluginEstimate read_estimate(MessageReader& message, std::size_t cameras) {
  PluginEstimate estimate;
  estimate.estimate = message.read<vinebench_estimate>();
  estimate.estimate.counts = nullptr;
  estimate.counts = message.read_list<vinebench_counts>();
  if (estimate.counts.size() != cameras) {
    fail("expected the counts of {} cameras, found {}", cameras, estimate.counts.size());
  }
  return estimate;
}

void add_summary(MessageWriter& message, const PluginSummary& summary) {
  message.add_list(summary.trajectory.data(), summary.trajectory.size());
  message.add_list(summary.keyframes.data(), summary.keyframes.size());
  message.add(summary.landmarks);
}

PluginSummary read_summary(MessageReader& message) {
  PluginSummary summary;
  summary.trajectory = message.read_list<vinebench_stamped_pose>();
  summary.keyframes = message.read_list<vinebench_stamped_pose>();
  summary.landmarks = message.read<std::int64_t>();
  return summary;
}

}  // namespace vinebench::harness
