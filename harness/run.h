// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "harness/judge/run_report.h"
#include "harness/run/film.h"
#include "harness/run/watcher.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// Maps to load before a run and to save after it. None if empty.
struct MapFiles {
  std::filesystem::path load;
  std::filesystem::path save;
  std::filesystem::path cloud;  ///< PLY
};

struct RunOptions {
  std::filesystem::path folder;  ///< for the results; nothing is written if empty
  MapFiles maps;
  int images = 12;                   ///< frames whose images are kept as PNG
  bool film = false;                 ///< keep small pictures for a report, and the landmarks
  Film::Features features;           ///< for these; run_mapping_system() knows
  std::ostream* progress = nullptr;  ///< receives the progress
  bool terminal = false;             ///< `progress` is a terminal
  std::string title = "run";         ///< of the progress line
  std::function<bool()> stopped;     ///< polled before each frame
  std::vector<Sink*> sinks;          ///< receive each tick after the run's own sinks
  Watcher* watcher = nullptr;        ///< looks on, after all of these
  NamedValues libraries;             ///< that made the frames, and their versions
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

struct RunOutcome {
  bool interrupted = false;  ///< by `stopped`; there is no metrics.json
  RunReport report;          ///< of the frames up to an interruption
  std::string summary;       ///< human-readable: degraded segments and their causes
};

/// Runs a SLAM system on a source in lockstep, evaluates it and writes the run's files. The folder
/// must have been prepared.
RunOutcome run_lockstep_and_judge(const Trial& trial, FrameSource& source, SlamSystem& slam,
                                  const RunOptions& options);

/// Throws Error if there are any: other systems than the core have none.
void expect_no_maps(const MapFiles& maps);

/// Throws Error if the folder for a map does not exist, so that the error comes before a long run.
void check_map_folders(const MapFiles& maps);

/// Runs a SLAM system on a source and evaluates it. Loads the maps of the options before and saves
/// them after.
RunOutcome run_mapping_system(const Trial& trial, FrameSource& source, slam::MappingSystem& slam,
                              const RunOptions& options);

}  // namespace vinebench::harness
