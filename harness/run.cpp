// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run.h"

#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/judge/diagnosis.h"
#include "harness/report/report_json.h"
#include "harness/report/run_folder.h"
#include "harness/run/frame_images.h"
#include "harness/run/hash_environment.h"
#include "harness/run/lockstep.h"
#include "harness/run/progress.h"
#include "harness/run/run_hash.h"

namespace vinebench::harness {
namespace {

/// The sinks of one run.
struct Sinks {
  Sinks(const Trial& trial, const FrameSource& source, const RunOptions& options)
      : recorder(source.rig(), trial.site.tags, trial.told_tags) {
    if (!options.folder.empty()) {
      images.emplace(options.folder / "frames", source.rig(), source.size(), options.images);
      if (options.film) {
        film.emplace(options.folder, source.rig(), source.size(), options.features);
      }
    }
    if (options.progress != nullptr) {
      progress.emplace(*options.progress, options.terminal, options.title, source.size());
    }
  }
  std::vector<Sink*> list() {
    std::vector<Sink*> sinks{&recorder, &hash};
    if (images) sinks.push_back(&*images);
    if (film) sinks.push_back(&*film);
    if (progress) sinks.push_back(&*progress);
    return sinks;
  }

  RunRecorder recorder;
  RunHash hash;
  std::optional<FrameImages> images;
  std::optional<Film> film;
  std::optional<Progress> progress;
};

RunCost cost_of(const FrameSource& source, const SlamSystem& slam, std::int64_t frames,
                double wall_seconds) {
  StageTimes times = source.times();
  times.merge(slam.times());
  const double simulated = static_cast<double>(frames) / source.rig().rate_hz;
  return {.wall_seconds = wall_seconds,
          .cpu_seconds = cpu_seconds(),
          .real_time_factor = simulated / wall_seconds,
          .peak_rss_mib = peak_rss_mib(),
          .stages = stage_timings(times)};
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void expect_folder(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    fail("{}: folder {} does not exist{}", file.string(), folder.string(),
         error ? ": " + error.message() : "");
  }
}

}  // namespace

RunOutcome run_lockstep_and_judge(const Trial& trial, FrameSource& source, SlamSystem& slam,
                                  const RunOptions& options) {
  if (const auto* blind = trial.blind()) find_cameras(source.rig(), blind->cameras);
  Sinks sinks(trial, source, options);
  std::vector<Sink*> all = sinks.list();
  all.insert(all.end(), options.sinks.begin(), options.sinks.end());
  if (options.watcher != nullptr) {
    options.watcher->begin({options.title, trial.site, source.rig(), source.size(),
                            trial.box_share(), options.features});
    all.push_back(options.watcher);
  }
  run_lockstep(source, slam, all, options.stopped);
  const double wall = seconds_since(options.started) -
                      (options.watcher != nullptr ? options.watcher->waited_seconds() : 0);

  const RunRecord& record = sinks.recorder.record();
  RunOutcome outcome;
  RunReport& report = outcome.report = judge(record, trial);
  if (!options.folder.empty()) write_run_files(options.folder, trial, record, report);
  outcome.summary =
      format_diagnosis(record, report.diagnosis) + format_left_out(report.results.consistency);
  if (report.checks.empty() || !all_hold(report.checks)) {
    outcome.summary += format_patterns(report.patterns);
    outcome.summary += format_discrepancies(report.discrepancies);
  }
  // A system that runs after the last frame may be stopped there.
  const bool whole = report.frames == source.size() && !record.summary.trajectory.empty();
  outcome.interrupted = options.stopped && options.stopped() && !whole;
  if (outcome.interrupted) return outcome;

  sinks.hash.add(json_text(hashed_json(report)));
  report.hash = sinks.hash.digits();
  report.hash_environment = hash_environment(options.libraries);
  report.cost = cost_of(source, slam, report.frames, wall);
  if (!options.folder.empty()) write_metrics(options.folder, report);
  return outcome;
}

void expect_no_maps(const MapFiles& maps) {
  if (!maps.load.empty() || !maps.save.empty() || !maps.cloud.empty()) {
    fail("--load-map, --save-map and --save-cloud require the built-in SLAM core");
  }
}

void check_map_folders(const MapFiles& maps) {
  expect_folder(maps.save);
  expect_folder(maps.cloud);
}

RunOutcome run_mapping_system(const Trial& trial, FrameSource& source, slam::MappingSystem& slam,
                              const RunOptions& options) {
  check_map_folders(options.maps);
  if (!options.maps.load.empty()) slam.load_map(options.maps.load);
  RunOptions with_features = options;
  with_features.features = [&slam] { return slam.supporting_features(); };
  const RunOutcome outcome = run_lockstep_and_judge(trial, source, slam, with_features);
  if (!options.maps.save.empty()) slam.save_map(options.maps.save);
  if (!options.maps.cloud.empty()) slam.save_cloud(options.maps.cloud);
  if (options.film && !options.folder.empty()) slam.save_cloud(options.folder / kLandmarksFile);
  return outcome;
}

}  // namespace vinebench::harness
