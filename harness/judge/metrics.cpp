// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/metrics.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vinebench::harness {
namespace {

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// Mean per frame of one count, by camera.
Json camera_means(const RunRecord& record, int CameraCounts::*count) {
  Json means = Json::object();
  for (std::size_t camera = 0; camera < record.rig.cameras.size(); ++camera) {
    double sum = 0;
    for (const Tick& tick : record.ticks) {
      if (camera < tick.estimate.cameras.size()) sum += tick.estimate.cameras[camera].*count;
    }
    const double ticks = static_cast<double>(std::max<std::size_t>(1, record.ticks.size()));
    means[record.rig.cameras[camera].name] = sum / ticks;
  }
  return means;
}

void add_errors(Json& metrics, const RunResults& results) {
  const auto& [corrected, live] = std::tie(results.corrected, results.live);
  metrics["ate_rmse_m"] = corrected ? Json(corrected->ate.rmse) : Json();
  metrics["ate_max_m"] = corrected ? Json(corrected->ate.max) : Json();
  metrics["ate_live_rmse_m"] = live ? Json(live->ate.rmse) : Json();
  metrics["ate_origin_rmse_m"] = corrected ? Json(corrected->origin.rmse) : Json();
  metrics["rpe_trans_percent"] = corrected ? or_null(corrected->rpe_trans_percent) : Json();
}

/// Number of data faults by kind; no key if there was none.
void count_events(const Tick& tick, Json& metrics) {
  for (const SourceEvent& event : tick.events) {
    Json& count = metrics["input_faults"][event.event];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
}

/// Mean share of each camera's image that each class covers; no key where there is nothing.
Json occlusion_metrics(const RunRecord& record) {
  Json means = Json::object();
  for (std::size_t camera = 0; camera < record.rig.cameras.size(); ++camera) {
    Occlusion sum;
    for (const Tick& tick : record.ticks) {
      if (camera >= tick.truth.occlusion.size()) continue;
      for (std::size_t c = 0; c < kOccluderClasses; ++c) {
        sum.shares[c] += tick.truth.occlusion[camera].shares[c];
      }
    }
    for (std::size_t c = 0; c < kOccluderClasses; ++c) {
      if (sum.shares[c] == 0) continue;
      means[record.rig.cameras[camera].name][name_of(static_cast<OccluderClass>(c))] =
          sum.shares[c] / static_cast<double>(record.ticks.size());
    }
  }
  return means;
}

Json blind_metrics(const OcclusionSegment& blind) {
  return {{"seconds", blind.seconds},
          {"metres", blind.metres},
          {"lost_frames", blind.lost_frames},
          {"inliers_clear", blind.inliers_clear},
          {"inliers_blind", blind.inliers_blind},
          {"inliers_drop", or_null(blind.inliers_drop())}};
}

double cpu_of_process() {
  double seconds = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
  }
  return seconds;
}

/// A process that a shell became by `exec` inherits the shell's time and that of its children.
const double kCpuAtStart = cpu_of_process();

}  // namespace

Json result_metrics(const Trial& trial, const RunRecord& record, const RunResults& results) {
  Json metrics;
  metrics["scenario"] = trial.name;
  metrics["seed"] = trial.seed;
  metrics["frames"] = record.ticks.size();
  metrics["coverage"] = results.coverage;
  metrics["lost_frames"] = results.lost_frames;
  metrics["losses"] = results.losses;
  add_errors(metrics, results);
  if (results.consistency && results.consistency->frames > 0) {
    metrics["nees_mean"] = results.consistency->nees_mean;
    metrics["nees_within_95"] = results.consistency->within_95;
  }
  metrics["end_error_m"] = or_null(results.end_error);
  metrics["loop_closures"] = {{"correct", results.loops.correct()},
                              {"wrong", results.loops.wrong()},
                              {"missed", results.loops.missed.size()}};
  metrics["keyframes"] = record.summary.keyframes.size();
  metrics["landmarks"] = record.summary.landmarks;
  metrics["features"] = camera_means(record, &CameraCounts::features);
  metrics["inliers"] = camera_means(record, &CameraCounts::inliers);
  for (const Tick& tick : record.ticks) count_events(tick, metrics);
  if (results.blind) metrics["blind"] = blind_metrics(*results.blind);
  return metrics;
}

void add_unhashed_metrics(const RunRecord& record, const RunResults& results, Json& metrics) {
  if (Json shares = occlusion_metrics(record); !shares.empty()) metrics["occlusion"] = shares;
  if (results.blind) metrics["blind"]["occluder"] = name_of(results.blind->occluder);
  if (results.consistency) metrics["nees_left_out"] = results.consistency->not_invertible;
}

double percentile(std::vector<double> samples, double share) {
  std::ranges::sort(samples);
  const double place = share * static_cast<double>(samples.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, samples.size() - 1);
  return std::lerp(samples[below], samples[above], place - static_cast<double>(below));
}

Json timing_metrics(const StageTimes& times) {
  Json timing = Json::object();
  for (const auto& [stage, samples] : times.samples()) {
    if (samples.empty()) continue;
    const double sum = std::accumulate(samples.begin(), samples.end(), 0.0);
    timing[stage] = {{"mean", sum / static_cast<double>(samples.size())},
                     {"p50", percentile(samples, 0.5)},
                     {"p95", percentile(samples, 0.95)}};
  }
  return timing;
}

double peak_rss_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // KiB on Linux
}

double cpu_seconds() {
  return cpu_of_process() - kCpuAtStart;
}

Json checks_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& check : checks) {
    list.push_back({{"what", check.what},
                    {"measured", check.measured},
                    {"expected", check.expected},
                    {"ok", check.ok}});
  }
  return list;
}

std::vector<Check> checks_of(const Json& list) {
  std::vector<Check> checks;
  for (const Json& check : list) {
    checks.push_back(
        {check.at("what"), check.at("measured"), check.at("expected"), check.at("ok").get<bool>()});
  }
  return checks;
}

}  // namespace vinebench::harness
