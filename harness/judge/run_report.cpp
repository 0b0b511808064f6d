// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "harness/judge/diagnosis.h"

namespace vinebench::harness {
namespace {

CameraReport report_of_camera(const RunRecord& record, std::size_t camera) {
  CameraReport report{.name = record.rig.cameras[camera].name};
  for (const Tick& tick : record.ticks) {
    if (camera < tick.estimate.cameras.size()) {
      report.features += tick.estimate.cameras[camera].features;
      report.inliers += tick.estimate.cameras[camera].inliers;
    }
    if (camera >= tick.truth.occlusion.size()) continue;
    for (std::size_t c = 0; c < kOccluderClasses; ++c) {
      report.occlusion.shares[c] += tick.truth.occlusion[camera].shares[c];
    }
  }
  const double ticks = static_cast<double>(std::max<std::size_t>(1, record.ticks.size()));
  report.features /= ticks;
  report.inliers /= ticks;
  for (double& share : report.occlusion.shares) share /= ticks;
  return report;
}

std::vector<FaultCount> count_faults(const RunRecord& record) {
  std::vector<FaultCount> faults;
  for (const Tick& tick : record.ticks) {
    for (const SourceEvent& event : tick.events) {
      const auto known = std::ranges::find(faults, event.event, &FaultCount::kind);
      if (known == faults.end()) {
        faults.push_back({event.event, 1});
      } else {
        ++known->count;
      }
    }
  }
  return faults;
}

Check check_of(const SlamFailure& failure) {
  const std::string place =
      failure.frame ? fmt::format("frame {}", *failure.frame) : "after the last frame";
  return {"SLAM system", fmt::format("{} ({})", failure.cause, place), "no failure", false};
}

}  // namespace

RunReport judge(const RunRecord& record, const Trial& trial) {
  RunReport report;
  report.scenario = trial.name;
  report.seed = trial.seed;
  report.frames = static_cast<std::int64_t>(record.ticks.size());
  report.results = measure(record, trial);
  report.keyframes = record.summary.keyframes.size();
  report.landmarks = record.summary.landmarks;
  for (std::size_t camera = 0; camera < record.rig.cameras.size(); ++camera) {
    report.cameras.push_back(report_of_camera(record, camera));
  }
  report.input_faults = count_faults(record);
  report.diagnosis = diagnose(record, report.results, trial);
  report.patterns = error_patterns(record, report.results);
  report.discrepancies = trial.discrepancies;
  report.failure = record.failure;
  if (report.failure) report.checks.push_back(check_of(*report.failure));
  std::ranges::move(check_trial(trial, report.results), std::back_inserter(report.checks));
  return report;
}

}  // namespace vinebench::harness
