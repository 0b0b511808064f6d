// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

#include "harness/datasets/files/json_file.h"
#include "harness/experiment/randomisation.h"
#include "harness/jobs/run_scenario.h"
#include "harness/judge/diagnosis.h"
#include "harness/report/report_json.h"
#include "python/requests.h"
#include "python/scenarios.h"
#include "python/systems.h"

namespace vinebench::python {
namespace {

using Overrides = std::map<std::string, py::object>;
using FilePath = std::filesystem::path;

/// The trajectories of a run, which its report does not have. Tells `on_truth`, unless it is None,
/// the true pose of each frame once that is answered.
class Trajectories : public harness::Sink {
 public:
  explicit Trajectories(py::object on_truth) : on_truth_(std::move(on_truth)) {}

  void on_tick(const Sample& sample, const Estimate& estimate) override {
    stamps_.push_back(sample.frame.stamp);
    if (sample.truth.known) truth_.push_back({sample.frame.stamp, sample.truth.T_world_body});
    if (!on_truth_.is_none()) {
      const py::gil_scoped_acquire acquired;
      on_truth_(sample.frame.stamp, sample.truth.T_world_body.matrix());
    }
    if (estimate.T_map_body) live_.push_back({sample.frame.stamp, *estimate.T_map_body});
  }
  void on_finish(const SlamSummary& summary) override { summary_ = summary; }

  Stamp stamp(std::size_t tick) const { return stamps_.at(tick); }
  py::dict arrays() const {
    py::dict arrays = dict_of(summary_);
    arrays["truth"] = rows_of(truth_);
    arrays["live"] = rows_of(live_);
    return arrays;
  }

 private:
  py::object on_truth_;
  std::vector<Stamp> stamps_;
  Trajectory truth_;
  Trajectory live_;
  SlamSummary summary_;
};

/// ^C, and whatever else a signal's handler in Python raises, ends the run after its frame; so does
/// a system that wants to.
class Interruption {
 public:
  explicit Interruption(py::object adapter) : adapter_(std::move(adapter)) {}

  bool stopped() {
    if (raised_) return true;
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() == 0) {
      return !adapter_.is_none() && adapter_.attr("stopped")().cast<bool>();
    }
    raised_.emplace();
    return true;
  }
  /// Raises what the handler did, if it did.
  void raise_again() {
    if (raised_) throw *std::exchange(raised_, std::nullopt);
  }

 private:
  py::object adapter_;
  std::optional<py::error_already_set> raised_;
};

py::list segments_of(const harness::RunReport& report, const Rig& rig,
                     const Trajectories& trajectories) {
  py::list segments;
  for (const harness::DegradedSegment& segment : report.diagnosis) {
    py::list cameras;
    for (const std::size_t camera : segment.cameras) cameras.append(rig.cameras.at(camera).name);
    py::dict entry;
    entry["begin"] = to_seconds(trajectories.stamp(segment.first));
    entry["end"] = to_seconds(trajectories.stamp(segment.last));
    entry["cause"] = harness::name_of(segment.cause);
    entry["cameras"] = py::tuple(cameras);
    entry["occluder"] =
        segment.occluder ? py::object(py::str(name_of(*segment.occluder))) : py::none();
    entry["share"] = segment.share;
    entry["error_growth"] = segment.error_growth;
    entry["untracked"] = segment.untracked;
    entry["inliers"] = segment.inliers;
    entry["usual_inliers"] = segment.usual_inliers;
    segments.append(entry);
  }
  return segments;
}

struct Run {
  harness::ScenarioConfig scenario;
  harness::Machine machine;
  std::optional<FilePath> out;
  int threads = 1;
  bool progress = false;
  py::object adapter;   ///< None: the scenario's own system
  py::object on_truth;  ///< or None
};

harness::RunOutcome run_judged(const Run& run, harness::RunOptions options) {
  std::optional<FolderLock> lock;
  if (run.out) {
    options.folder = *run.out;
    lock.emplace(harness::prepare_scenario_folder(*run.out, run.scenario));
  }
  if (run.adapter.is_none()) {
    return harness::run_scenario(run.scenario, run.machine, run.threads, options);
  }
  const harness::SystemMaker make = [&](const harness::SystemSetup& setup) {
    return make_python_system(run.adapter, setup);
  };
  return harness::run_scenario_with(make, run.scenario, run.machine, run.threads, options);
}

py::dict outcome_of(const Run& run) {
  Trajectories trajectories(run.on_truth);
  Interruption interruption(run.adapter);
  harness::RunOptions options;
  options.title = run.scenario.name;
  options.sinks = {&trajectories};
  options.stopped = [&] { return interruption.stopped(); };
  if (run.progress) {
    options.progress = &std::cerr;
    options.terminal = isatty(STDERR_FILENO) == 1;
  }
  harness::RunOutcome outcome;
  Rig rig;
  {
    const py::gil_scoped_release others_may_run;
    rig = load_rig(run.scenario.simulation.rover.rig);
    outcome = run_judged(run, options);
  }
  interruption.raise_again();
  py::dict result;
  result["metrics"] = harness::json_text(harness::to_json(outcome.report));
  result["verdict"] = harness::verdict_of(outcome.report.checks);
  result["passed"] = harness::all_hold(outcome.report.checks);
  result["summary"] = outcome.summary;
  result["degraded"] = segments_of(outcome.report, rig, trajectories);
  result["trajectories"] = trajectories.arrays();
  return result;
}

py::dict run(const FilePath& scenario, std::optional<std::int64_t> seed, const Overrides& set,
             const std::optional<FilePath>& randomise, const std::optional<FilePath>& out,
             int threads, bool progress, const py::object& adapter, const py::object& on_truth) {
  const harness::FramesRequest request =
      frames_request(scenario, seed, set, randomise, {}, {}, threads);
  Run run;
  run.machine = request.machine;
  run.out = out;
  run.threads = std::max(1, threads);
  run.progress = progress;
  run.adapter = adapter;
  run.on_truth = on_truth;
  {
    const py::gil_scoped_release others_may_run;
    run.scenario = scenario_of(request);
  }
  return outcome_of(run);
}

}  // namespace

void define_runs(py::module_& module) {
  module.def("run", &run, py::arg("scenario"), py::kw_only(), py::arg("seed"), py::arg("set"),
             py::arg("randomise"), py::arg("out"), py::arg("threads"), py::arg("progress"),
             py::arg("adapter"), py::arg("on_truth"));
}

}  // namespace vinebench::python
