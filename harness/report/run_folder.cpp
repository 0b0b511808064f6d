// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/run_folder.h"

#include <fmt/format.h>

#include <map>
#include <regex>
#include <system_error>

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/files/dataset_folder.h"
#include "harness/datasets/files/json_file.h"
#include "harness/judge/diagnosis.h"
#include "harness/report/events.h"
#include "harness/report/plot.h"
#include "harness/report/report_json.h"
#include "harness/report/timeline.h"
#include "harness/run/film.h"

namespace vinebench::harness {
namespace {

void remove_files(const std::filesystem::path& folder, const std::regex& names) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (std::regex_match(entry.path().filename().string(), names)) {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

/// Images and what a killed run has left unfinished.
void remove_old_files(const std::filesystem::path& folder) {
  static const std::regex images("[0-9]{6,}_.*\\.png");
  static const std::regex film("[0-9]{6,}\\.jpg|film\\.json");
  for (const auto& inner : {folder, folder / "frames", folder / kFilmFolder}) {
    remove_unfinished(inner);
  }
  remove_files(folder / "frames", images);
  remove_files(folder / kFilmFolder, film);
}

/// A line for each line of estimate.tum, whose format has no place for it.
std::string format_statuses(const RunRecord& record) {
  std::map<Stamp, TrackingStatus> statuses;
  for (const Tick& tick : record.ticks) statuses[tick.stamp] = tick.estimate.status;
  std::string text = "#timestamp [s],status\n";
  for (const StampedPose& pose : record.summary.trajectory) {
    const auto status = statuses.find(pose.stamp);
    text += fmt::format("{},{}\n", format_seconds(pose.stamp),
                        status == statuses.end() ? "unknown" : status_name(status->second));
  }
  return text;
}

}  // namespace

FolderLock prepare_run_folder(const std::filesystem::path& folder, const std::string& name,
                              const std::string& settings) {
  try {
    FolderLock lock(folder);
    create_inner_folder(folder / "frames");
    write_file_atomically(folder / name, settings);
    std::error_code ignored;
    for (const char* stale : {"metrics.json", kInputsFile, kLandmarksFile}) {
      std::filesystem::remove(folder / stale, ignored);
    }
    remove_old_files(folder);
    return lock;
  } catch (const Error& error) {
    fail("output folder {}", error.what());
  }
}

void write_run_files(const std::filesystem::path& folder, const Trial& trial,
                     const RunRecord& record, const RunReport& report) {
  write_tum(true_trajectory(record), folder / "groundtruth.tum");
  write_tum(live_trajectory(record), folder / "estimate_live.tum");
  write_tum(record.summary.trajectory, folder / "estimate.tum");
  write_file_atomically(folder / "estimate_status.csv", format_statuses(record));
  write_tum(record.summary.keyframes, folder / "keyframes.tum");
  write_file_atomically(folder / "events.jsonl",
                        format_events(record, report.results, report.diagnosis, trial.box_share()));
  write_file_atomically(folder / "summary.txt", format_diagnosis(record, report.diagnosis));
  write_file_atomically(folder / "plot.svg", plot_svg(trial, record, report.results));
  write_file_atomically(folder / kTimelineFile, format_timeline(record));
  write_file_atomically(folder / kSiteFile, json_text(site_json(trial.site, record.rig)) + "\n");
}

void write_metrics(const std::filesystem::path& folder, const RunReport& report) {
  write_file_atomically(folder / "metrics.json", json_text(to_json(report), 2) + "\n");
}

}  // namespace vinebench::harness
