// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "harness/systems/host/plugin_link.h"
#include "harness/systems/host/wire.h"

namespace vinebench::harness {

// The content of each message.

/// Of kCreate.
void add_setup(MessageWriter& message, const vinebench_setup& setup);

/// The setup of a message, with the memory of all that it points to.
class ReceivedSetup {
 public:
  explicit ReceivedSetup(MessageReader& message);
  ReceivedSetup(const ReceivedSetup&) = delete;
  ReceivedSetup& operator=(const ReceivedSetup&) = delete;
  const vinebench_setup& get() const { return setup_; }

 private:
  std::string rig_, settings_;
  std::vector<std::string> camera_names_, pair_names_, families_;
  std::vector<vinebench_camera> cameras_;
  std::vector<vinebench_stereo_pair> pairs_;
  std::vector<std::int32_t> tag_cameras_;
  std::vector<vinebench_tag> tags_;
  vinebench_setup setup_{};
};

/// An image in shared memory.
struct SharedImage {
  std::int64_t offset;  ///< bytes; negative if the camera delivered none
  std::int32_t width, height, channels;
};

/// Of kProcess; the frame's own images are not read.
void add_frame(MessageWriter& message, const vinebench_frame& frame,
               const std::vector<SharedImage>& images);

/// The frame of a message; its images are in `memory`.
PluginFrame read_frame(MessageReader& message, const std::uint8_t* memory);

/// Of kEstimate.
void add_estimate(MessageWriter& message, const PluginEstimate& estimate);
/// Throws Error unless it has a count for each of `cameras`.
PluginEstimate read_estimate(MessageReader& message, std::size_t cameras);

/// Of kSummary.
void add_summary(MessageWriter& message, const PluginSummary& summary);
PluginSummary read_summary(MessageReader& message);

}  // namespace vinebench::harness
