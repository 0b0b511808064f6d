// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "harness/judge/metrics.h"
#include "harness/judge/verdict.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// Maps that a run begins with and leaves. None where empty.
struct MapFiles {
  std::filesystem::path load;
  std::filesystem::path save;
  std::filesystem::path cloud;  ///< PLY
};

struct RunOptions {
  std::filesystem::path folder;  ///< where results go; nothing is written when empty
  MapFiles maps;
  int images = 12;                   ///< frames whose images are kept as PNG
  std::ostream* progress = nullptr;  ///< told how far the run is
  bool terminal = false;             ///< `progress` is a terminal
  std::string title = "run";         ///< of the progress line
  std::function<bool()> stopped;     ///< asked before each frame
  std::vector<Sink*> sinks;          ///< told of each tick after the run's own
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

struct RunOutcome {
  bool interrupted = false;  ///< `stopped` said so; there is no metrics.json and no verdict
  std::int64_t frames = 0;
  std::vector<Check> checks;
  Json metrics;
  std::string hash;
  std::string summary;  ///< for people: where the estimate suffered, and from what
};

/// Runs a SLAM system on a source in lockstep, judges it and writes the run's files. The folder
/// must have been prepared.
RunOutcome run_lockstep_and_judge(const Trial& trial, FrameSource& source, SlamSystem& slam,
                                  const RunOptions& options);

/// Throws Error where a map is to be written into a folder that is not there: better before a long
/// run than after it.
void check_map_folders(const MapFiles& maps);

/// Runs a SLAM system on a source and judges it, with the maps of the options loaded before and
/// saved after.
RunOutcome run_mapping_system(const Trial& trial, FrameSource& source, slam::MappingSystem& slam,
                              const RunOptions& options);

}  // namespace vinebench::harness
