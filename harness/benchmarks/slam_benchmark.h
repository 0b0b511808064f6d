// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/truth/frame_source.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// Settings of `vinebench bench slam`: the SLAM core on frames in memory, so that the times include
/// neither rendering nor decoding.
struct SlamBenchmark {
  std::string name;
  Rig rig;
  std::vector<RegisteredTag> tags;
  slam::SlamConfig slam;
  std::vector<Frame> frames;
  int threads = 2;
  int warm_up = 10;  ///< frames at the beginning that are not measured
};

/// The first frames of a source, at most `count`, with grey images.
std::vector<Frame> preload(FrameSource& source, std::int64_t most);

/// Measures the whole rig; its stereo pairs only, if it also has tag cameras; and its first pair
/// only, if it has several. For each `wall_ms` and `cpu_ms` (all threads) a frame (mean, p50, p95,
/// max), `cpu_ms_by_quarter` of the run, `stages_ms`, `tracked` share and `memory_mib`, the peak
/// memory beyond the frames. For single images `orb_cpu_ms` and `tags_cpu_ms`. Throws Error if
/// there are too few frames.
nlohmann::ordered_json measure_slam(const SlamBenchmark& benchmark);

/// The result as a human-readable table.
std::string slam_table(const nlohmann::ordered_json& result);

}  // namespace vinebench::harness
