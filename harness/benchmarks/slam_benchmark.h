// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/truth/frame_source.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// What `vinebench bench slam` measures: the SLAM core on frames that are in memory already, so
/// that neither rendering nor decoding is in the figures.
struct SlamBenchmark {
  std::string name;
  Rig rig;
  std::vector<RegisteredTag> tags;
  slam::SlamConfig slam;
  std::vector<Frame> frames;
  int threads = 2;
  int warm_up = 10;  ///< frames at the beginning that do not count
};

/// The first frames of a source, at most so many, their images in grey.
std::vector<Frame> preload(FrameSource& source, std::int64_t most);

/// Measures the whole rig; its stereo pairs alone where it has tag cameras too; and its first pair
/// alone where it has several. For each `wall_ms` (p50, p95) and `cpu_ms` (mean, p50, p95; all
/// threads) a frame, `cpu_ms_by_quarter` of the run, `stages_ms`, `tracked` share and `memory_mib`,
/// what the run held at most beyond the frames. Of single images `orb_cpu_ms` and `tags_cpu_ms`
/// (p50, p95). Throws Error when there are too few frames.
nlohmann::ordered_json measure_slam(const SlamBenchmark& benchmark);

/// The result as a table for people.
std::string slam_table(const nlohmann::ordered_json& result);

}  // namespace vinebench::harness
