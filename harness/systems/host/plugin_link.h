// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/slam_plugin.h"

namespace vinebench::harness {

/// A frame for a plug-in with the memory of its lists; that of the images is somebody else's.
struct PluginFrame {
  std::int64_t index = 0;
  std::int64_t stamp = 0;  ///< ns
  std::vector<vinebench_image> images{};
  std::vector<vinebench_imu_sample> imu{};
  std::vector<vinebench_wheel_sample> wheels{};
  std::vector<std::int64_t> image_stamps{};  ///< ns, of each image

  /// Valid while this is unchanged.
  vinebench_frame view() const {
    return {index,      stamp,         images.data(), imu.data(),
            imu.size(), wheels.data(), wheels.size(), image_stamps.data()};
  }
};

/// What a plug-in answers to a frame.
struct PluginEstimate {
  vinebench_estimate estimate{};  ///< its pointer to the counts is not used
  std::vector<vinebench_counts> counts;
};

/// What a plug-in answers in the end.
struct PluginSummary {
  std::vector<vinebench_stamped_pose> trajectory;
  std::vector<vinebench_stamped_pose> keyframes;
  std::int64_t landmarks = 0;
};

/// A system that a plug-in has created, in this process or in another one. Its answers are as the
/// plug-in gave them, unchecked. process() and finish() throw SystemFailure.
class PluginLink {
 public:
  virtual ~PluginLink() = default;
  virtual const std::string& name() const = 0;
  virtual PluginEstimate process(const vinebench_frame& frame) = 0;
  virtual PluginSummary finish() = 0;
};

}  // namespace vinebench::harness
