// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/replay.h"

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/notes_of_recording.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "harness/report/run_folder.h"
#include "harness/systems/other_system.h"

namespace vinebench::harness {
namespace {

constexpr std::string_view kSection = "slam.";

/// Keys of a scenario begin with "slam."; those of the section alone do not.
std::string key_of_section(const std::string& key) {
  if (!key.starts_with(kSection) || key.size() == kSection.size()) {
    fail("--set {}: expected a key of the SLAM core, such as slam.cameras", key);
  }
  return key.substr(kSection.size());
}

/// Of that file; keys of a scenario begin with "slam.".
YamlDocument settings_of(const std::filesystem::path& file,
                         const std::vector<Override>& overrides) {
  YamlDocument document = file.empty() ? YamlDocument() : YamlDocument::load(file);
  for (const auto& [key, value] : overrides) document.set(key_of_section(key), value);
  return document;
}

/// A recording has no site and no expectations.
Trial trial_of(const Recording& recording) {
  Trial trial;
  trial.name = recording.name;
  trial.told_tags = recording.tags;
  return trial;
}

std::string millimetres(const std::optional<double>& metres) {
  return metres ? fmt::format("{:.1f} mm", 1e3 * *metres) : "unknown";
}

}  // namespace

slam::SlamConfig replay_settings(const Recording& recording, const std::filesystem::path& file,
                                 const std::vector<Override>& overrides) {
  return settings_of(file.empty() ? recording.settings : file, overrides).read<slam::SlamConfig>();
}

SlamChoice replay_choice(const Recording& recording, const std::filesystem::path& file,
                         const std::vector<Override>& overrides) {
  if (!file.empty()) return settings_of(file, overrides).read<SlamChoice>();
  settings_of(recording.settings, {}).read<slam::SlamConfig>();
  return settings_of(recording.settings, overrides).read<SlamChoice>();
}

FolderLock prepare_replay_folder(const std::filesystem::path& folder, const SlamChoice& slam) {
  return prepare_run_folder(folder, "slam.resolved.yaml", format_yaml(slam));
}

RunOutcome run_replay(Recording recording, const slam::SlamConfig& slam, int threads,
                      const RunOptions& options) {
  WorkerPool pool(threads);
  const Trial trial = trial_of(recording);
  const auto system = slam::make_slam(slam, recording.rig, recording.tags, pool);
  DatasetReader source(std::move(recording), pool);
  return run_mapping_system(trial, source, *system, options);
}

RunOutcome run_replay(Recording recording, const SlamChoice& choice, int threads,
                      const RunOptions& options, const std::filesystem::path& plugin_host) {
  if (choice.is_core()) {
    const slam::SlamConfig& core = choice;
    return run_replay(std::move(recording), core, threads, options);
  }
  expect_no_maps(options.maps);
  std::optional<TemporaryFolder> temporary;
  if (options.folder.empty()) temporary.emplace();
  const Trial trial = trial_of(recording);
  const auto system = make_other_system(
      choice, recording.rig, notes_of(recording), threads,
      {plugin_host, temporary ? temporary->path() : options.folder, options.stopped});
  WorkerPool pool(threads);
  DatasetReader source(std::move(recording), pool);
  return run_lockstep_and_judge(trial, source, *system, options);
}

std::string format_replay(const RunReport& report) {
  const RunResults& results = report.results;
  std::optional<double> ate, origin, rpe;
  if (results.corrected) {
    ate = results.corrected->ate.rmse;
    origin = results.corrected->origin.rmse;
    rpe = results.corrected->rpe_trans_percent;
  }
  std::string text = fmt::format(
      "  frames tracked            {:.1f} % of {}, lost {} times\n"
      "  ATE, SE(3)-aligned        {}\n"
      "  ATE, first pose aligned   {}\n"
      "  RPE over 1 m              {}\n",
      100 * results.coverage, report.frames, results.losses, millimetres(ate), millimetres(origin),
      rpe ? fmt::format("{:.2f} %", *rpe) : "unknown");
  if (results.consistency && results.consistency->not_invertible > 0) {
    text +=
        fmt::format("  covariance not invertible {} frames\n", results.consistency->not_invertible);
  }
  if (report.failure) {
    text += fmt::format("  SLAM system               FAILED: {}\n", report.failure->cause);
  }
  for (const FaultCount& fault : report.input_faults) {
    text += fmt::format("  fault in the data         {} ({} times)\n", fault.kind, fault.count);
  }
  return text;
}

}  // namespace vinebench::harness
