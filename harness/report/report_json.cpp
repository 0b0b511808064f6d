// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/report_json.h"

#include "core/geometry/angle.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

void add_errors(const RunResults& results, Json& metrics) {
  const auto& [corrected, live] = std::tie(results.corrected, results.live);
  metrics["ate_rmse_m"] = corrected ? Json(corrected->ate.rmse) : Json();
  metrics["ate_max_m"] = corrected ? Json(corrected->ate.max) : Json();
  metrics["ate_live_rmse_m"] = live ? Json(live->ate.rmse) : Json();
  metrics["ate_origin_rmse_m"] = corrected ? Json(corrected->origin.rmse) : Json();
  metrics["rpe_trans_percent"] = corrected ? or_null(corrected->rpe_trans_percent) : Json();
}

Json camera_means(const RunReport& report, double CameraReport::*mean) {
  Json means = Json::object();
  for (const CameraReport& camera : report.cameras) means[camera.name] = camera.*mean;
  return means;
}

/// Share of each camera's image that each class covers; no key where there is nothing.
Json occlusion_json(const RunReport& report) {
  Json means = Json::object();
  for (const CameraReport& camera : report.cameras) {
    for (std::size_t c = 0; c < kOccluderClasses; ++c) {
      const auto occluder = static_cast<OccluderClass>(c);
      const double share = camera.occlusion.share(occluder);
      if (share > 0) means[camera.name][name_of(occluder)] = share;
    }
  }
  return means;
}

Json blind_json(const OcclusionSegment& blind) {
  return {{"seconds", blind.seconds},
          {"metres", blind.metres},
          {"lost_frames", blind.lost_frames},
          {"inliers_clear", blind.inliers_clear},
          {"inliers_blind", blind.inliers_blind},
          {"inliers_drop", or_null(blind.inliers_drop())}};
}

void add_cost(const RunCost& cost, Json& metrics) {
  metrics["real_time_factor"] = cost.real_time_factor;
  metrics["wall_seconds"] = cost.wall_seconds;
  metrics["cpu_seconds"] = cost.cpu_seconds;
  Json& timing = metrics["timing_ms"] = Json::object();
  for (const StageTiming& stage : cost.stages) {
    timing[stage.stage] = {{"mean", stage.mean}, {"p50", stage.median}, {"p95", stage.p95}};
  }
  metrics["peak_rss_mib"] = cost.peak_rss_mib;
}

/// Not part of the hash, so that runs of earlier programs keep theirs.
void add_gate_metrics(const RunResults& results, Json& metrics) {
  const auto degrees = [](double radians) { return radians / kRadiansPerDegree; };
  if (const auto& corrected = results.corrected) {
    const OrientationErrors& orientation = corrected->orientation;
    metrics["heading_rmse_deg"] = degrees(orientation.heading.rmse);
    metrics["heading_max_deg"] = degrees(orientation.heading.max);
    metrics["tilt_rmse_deg"] = degrees(orientation.tilt.rmse);
    metrics["tilt_max_deg"] = degrees(orientation.tilt.max);
    metrics["worst_frame"] = {{"error_m", corrected->worst.error},
                              {"t", to_seconds(corrected->worst.stamp)}};
  }
  const auto& world = results.corrected ? results.corrected->world : std::nullopt;
  metrics["ate_world_rmse_m"] = world ? Json(world->position.rmse) : Json();
  metrics["ate_world_p95_m"] = world ? Json(world->position.p95) : Json();
  const auto& live = results.live_world;
  metrics["ate_world_live_rmse_m"] = live ? Json(live->position.rmse) : Json();
  metrics["heading_world_rmse_deg"] =
      world ? Json(degrees(world->orientation.heading.rmse)) : Json();
  metrics["tilt_world_rmse_deg"] = world ? Json(degrees(world->orientation.tilt.rmse)) : Json();
  metrics["drift_m"] = results.drift ? Json(results.drift->error) : Json();
  metrics["drift_percent"] = results.drift ? Json(results.drift->percent) : Json();
  metrics["loop_returns"] = results.loops.returns;
}

Json failure_json(const SlamFailure& failure) {
  return {{"cause", failure.cause}, {"frame", or_null(failure.frame)}};
}

Json patterns_json(const std::vector<ErrorPattern>& patterns) {
  Json list = Json::array();
  for (const ErrorPattern& pattern : patterns) {
    Json json{{"pattern", name_of(pattern.kind)}, {"size", pattern.size}, {"share", pattern.share}};
    if (pattern.kind == ErrorPatternKind::kStep) json["t"] = to_seconds(pattern.stamp);
    list.push_back(std::move(json));
  }
  return list;
}

Json discrepancies_json(const std::vector<Discrepancy>& discrepancies) {
  Json list = Json::array();
  for (const Discrepancy& d : discrepancies) {
    list.push_back(
        {{"of", d.of}, {"what", d.what}, {"size", d.size}, {"unit", d.unit}, {"px", d.pixels}});
  }
  return list;
}

void add_unhashed(const RunReport& report, Json& metrics) {
  const RunResults& results = report.results;
  if (report.failure) metrics["failure"] = failure_json(*report.failure);
  if (Json shares = occlusion_json(report); !shares.empty()) metrics["occlusion"] = shares;
  if (results.blind) metrics["blind"]["occluder"] = name_of(results.blind->occluder);
  if (results.consistency) metrics["nees_left_out"] = results.consistency->not_invertible;
  add_gate_metrics(results, metrics);
  metrics["error_patterns"] = patterns_json(report.patterns);
  metrics["discrepancies"] = discrepancies_json(report.discrepancies);
}

}  // namespace

Json to_json(const RunReport& report) {
  Json metrics{{"scenario", report.scenario}, {"seed", report.seed}, {"version", kVersion}};
  metrics.update(hashed_json(report));
  add_cost(report.cost, metrics);
  metrics["hash"] = report.hash;
  for (const auto& [name, value] : report.hash_environment) {
    metrics["hash_environment"][name] = value;
  }
  add_unhashed(report, metrics);
  metrics["expectations"] = checks_json(report.checks);
  return metrics;
}

Json hashed_json(const RunReport& report) {
  const RunResults& results = report.results;
  Json metrics;
  metrics["scenario"] = report.scenario;
  metrics["seed"] = report.seed;
  metrics["frames"] = report.frames;
  metrics["coverage"] = results.coverage;
  metrics["lost_frames"] = results.lost_frames;
  metrics["losses"] = results.losses;
  add_errors(results, metrics);
  if (results.consistency && results.consistency->frames > 0) {
    metrics["nees_mean"] = results.consistency->nees_mean;
    metrics["nees_within_95"] = results.consistency->within_95;
  }
  metrics["end_error_m"] = or_null(results.end_error);
  metrics["loop_closures"] = {{"correct", results.loops.correct()},
                              {"wrong", results.loops.wrong()},
                              {"missed", results.loops.missed.size()}};
  metrics["keyframes"] = report.keyframes;
  metrics["landmarks"] = report.landmarks;
  metrics["features"] = camera_means(report, &CameraReport::features);
  metrics["inliers"] = camera_means(report, &CameraReport::inliers);
  for (const FaultCount& fault : report.input_faults) {
    metrics["input_faults"][fault.kind] = fault.count;
  }
  if (results.blind) metrics["blind"] = blind_json(*results.blind);
  return metrics;
}

Json checks_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& check : checks) {
    list.push_back({{"what", check.what},
                    {"measured", check.measured},
                    {"expected", check.expected},
                    {"ok", check.ok},
                    {"open", check.open},
                    {"kind", name_of(check.kind)}});
  }
  return list;
}

std::vector<Check> checks_of(const Json& list) {
  std::vector<Check> checks;
  for (const Json& check : list) {
    checks.push_back({check.at("what"), check.at("measured"), check.at("expected"),
                      check.at("ok").get<bool>(), kind_of(check.value("kind", "")),
                      check.value("open", false)});
  }
  return checks;
}

}  // namespace vinebench::harness
