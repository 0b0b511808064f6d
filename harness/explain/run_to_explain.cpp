// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/run_to_explain.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/files/files.h"
#include "core/files/json_depth.h"
#include "core/util/error.h"
#include "harness/jobs/simulation_versions.h"
#include "harness/report/stored_run.h"
#include "harness/run/hash_environment.h"
#include "harness/sets/child_process.h"

namespace vinebench::harness {
namespace {

StoredRun stored_metrics(const std::filesystem::path& folder) {
  std::optional<StoredRun> run = read_stored_run(folder / "metrics.json");
  if (!run) {
    fail("{}: expected the folder of a complete run, with metrics.json and scenario.resolved.yaml",
         folder.string());
  }
  return std::move(*run);
}

/// In which the run's environment differs from this process's.
std::string differences(const StoredRun& run, const sim::RendererConfig& renderer) {
  const NamedValues then = run.hash_environment();
  if (then.empty()) return "";
  // OpenGL starts in the child alone.
  return run_in_child("environment", [&] {
    return environment_differences(then, hash_environment(drawing_libraries(renderer)));
  });
}

constexpr double kMostFrames = 1e9;  // two years at 15 Hz

std::int64_t frames_of(const StoredRun& run, const std::filesystem::path& folder) {
  const std::optional<double> frames = run.value("/frames");
  if (!frames || *frames < 1) fail("{}: a run without frames", folder.string());
  if (*frames > kMostFrames) fail("{}: {} frames are not a run's", folder.string(), *frames);
  return static_cast<std::int64_t>(*frames);
}

std::vector<Stretch> chosen(const std::vector<Stretch>& segments, const StretchChoice& choice,
                            std::int64_t frames, double rate_hz) {
  const std::int64_t last = frames - 1;
  if (choice.from || choice.to) {
    const auto frame = [&](double seconds) {
      return static_cast<std::int64_t>(std::lround(std::clamp(seconds * rate_hz, 0., kMostFrames)));
    };
    const Stretch given{.first = choice.from ? frame(*choice.from) : 0,
                        .last = std::min(last, choice.to ? frame(*choice.to) : last)};
    if (given.first >= given.last) {
      fail("--from, --to: expected a part of the run's {:.2f} s",
           static_cast<double>(last) / rate_hz);
    }
    return {given};
  }
  if (choice.number) {
    const auto found = std::ranges::find(segments, *choice.number, &Stretch::number);
    if (found == segments.end()) {
      fail("--stretch {}: the run has {} degraded segments", *choice.number, segments.size());
    }
    return {*found};
  }
  if (segments.empty()) return {{.last = last}};
  return segments;
}

}  // namespace

std::vector<Stretch> degraded_stretches(const std::string& events, double rate_hz) {
  std::vector<Stretch> list;
  std::istringstream in(events);
  for (std::string line; std::getline(in, line);) {
    check_json_depth(line, "events.jsonl");
    const Json event = Json::parse(line, nullptr, false);
    if (!event.is_object() || event.value("event", "") != "explained") continue;
    const std::int64_t last = event.value("frame", std::int64_t{0});
    if (list.empty() || list.back().last != last) {
      const double seconds = event.value("until", 0.0) - event.value("from", 0.0);
      list.push_back({.number = static_cast<int>(list.size()) + 1,
                      .first = last - std::lround(seconds * rate_hz),
                      .last = last});
    }
    std::string cause = event.value("cause", "");
    if (event.contains("occluder")) cause += " by " + event.value("occluder", "");
    list.back().coincide.push_back(cause);
  }
  return list;
}

ExplainRequest read_run(const std::filesystem::path& folder, const StretchChoice& choice) {
  const StoredRun run = stored_metrics(folder);
  ExplainRequest request;
  request.scenario = load_scenario(folder / "scenario.resolved.yaml");
  request.live_poses = read_file(folder / "estimate_live.tum", FileKind::kTable);
  request.differences = differences(run, request.scenario.simulation.renderer);
  const double rate_hz = load_rig(request.scenario.simulation.rover.rig).rate_hz;
  const std::vector<Stretch> segments =
      degraded_stretches(read_file(folder / "events.jsonl", FileKind::kTable), rate_hz);
  request.stretches = chosen(segments, choice, frames_of(run, folder), rate_hz);
  return request;
}

}  // namespace vinebench::harness
