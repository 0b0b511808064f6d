// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "harness/jobs/simulated_frames.h"
#include "python/arrays.h"

namespace vinebench::python {

/// What a SLAM system is given of an instant, without truth.
struct SensorFrame {
  std::vector<std::string> cameras;  ///< names of the frame's images
  std::shared_ptr<const Frame> frame;
};

/// A frame with its truth, and what it comes from.
struct TrueFrame {
  std::shared_ptr<const harness::SimulatedFrames> source;
  std::shared_ptr<const harness::DatasetFrame> frame;

  std::size_t camera(const std::string& name) const;
  SensorFrame sensors() const;
};

std::vector<std::string> camera_names(const Rig& rig);

/// The frame that Python gives, a SensorFrame or a Frame, with its images in the rig's order.
/// Throws TypeError or ValueError for one that this rig cannot have taken.
Frame frame_for(const Rig& rig, const py::object& given);

/// Cameras, rigs, frames.
void define_frames(py::module_& module);

}  // namespace vinebench::python
