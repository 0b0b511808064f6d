// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/datasets/format/format_writer.h"
#include "harness/datasets/labels/image_labels.h"
#include "harness/experiment/scenario.h"
#include "harness/machine.h"

namespace vinebench::harness {

/// What is requested of each frame of a scenario.
struct FramesRequest {
  std::filesystem::path scenario;
  std::vector<Override> overrides;
  std::filesystem::path randomisation;  ///< distributions that the seed draws keys from; or none
  std::optional<std::int64_t> seed;     ///< the scenario's own if absent
  std::vector<std::string> cameras;     ///< names of the rig; all if empty
  std::vector<std::string> truth;       ///< some of truth_names()
  int threads = 2;                      ///< worker threads; they change no byte
  Machine machine;
};

/// "depth", "labels", "instances", "normals", "things" and "flow".
const std::vector<std::string>& truth_names();

/// Of cameras and truth, for all frames. Throws Error for an unknown name.
CapturePlan plan_of(const FramesRequest& request, const Rig& rig);

/// Reads the scenario of a request, on the machine's renderer where it leaves that open.
ScenarioConfig scenario_of(const FramesRequest& request);

/// Frames of a simulated scenario in memory, with their truth.
class SimulatedFrames {
 public:
  virtual ~SimulatedFrames() = default;

  virtual const ScenarioConfig& scenario() const = 0;
  const Rig& rig() const { return source().rig(); }  ///< nominal
  const Rig& true_rig() const { return source().true_rig(); }

  /// The labelled objects of an image; requires truth "things".
  ImageLabels things(const DatasetFrame& frame, std::size_t camera) const;

  /// From one frame to the next requested one, px; requires truth "flow". Throws Error for a camera
  /// with lens distortion.
  FlowTruth flow(const DatasetFrame& from, const DatasetFrame& to, std::size_t camera) const;

 private:
  virtual const SimulatedSource& source() const = 0;
};

}  // namespace vinebench::harness
