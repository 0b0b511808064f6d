// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/record.h"

#include <fmt/format.h>

#include <system_error>

#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/datasets/dataset_writer.h"
#include "harness/datasets/files/dataset_folder.h"
#include "harness/datasets/formats.h"
#include "harness/experiment/randomisation.h"
#include "harness/run/progress.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kMegabyte = 1e6;

std::string name_of_sequence(std::int64_t seed) {
  return fmt::format("seed_{:06}", seed);
}

ScenarioConfig scenario_of(const RecordRequest& request, std::optional<std::int64_t> seed) {
  ScenarioConfig scenario =
      load_drawn_scenario(request.scenario, request.overrides, request.randomisation, seed);
  if (request.untrusted) check_untrusted(scenario, request.scenario, *request.untrusted);
  sim::choose_backend(scenario.simulation.renderer, request.machine.gl_platform);
  return scenario;
}

/// Whether the folder has this sequence, complete. Removes an interrupted one.
bool has_sequence(const fs::path& folder, const std::string& settings) {
  if (!has_card(folder)) return false;
  const DatasetCard card = read_card(folder);
  if (card.settings_xxh128 != settings) {
    fail("recording {}: was made with other settings; expected the same to resume",
         folder.string());
  }
  if (card.complete) return true;
  clear_folder(folder);
  return false;
}

/// One sequence; adds to the outcome.
void record_sequence(const ScenarioConfig& scenario, const fs::path& plant_cache,
                     const fs::path& folder, const RecordOptions& options, const RecordWatch& watch,
                     RecordOutcome& outcome) {
  WorkerPool pool(options.threads);
  const Rig rig = load_rig(scenario.simulation.rover.rig);
  const auto source =
      sim::make_simulation(scenario.simulation, static_cast<std::uint64_t>(scenario.seed),
                           plant_cache, pool, plan_of(options, rig));
  if (source->size() == 0) {
    fail("--frames: the run has no frame from {} on", options.first);
  }
  DatasetWriter writer(folder, notes_of(scenario), *source, options, source->size());
  std::optional<Progress> progress;
  if (watch.progress != nullptr) {
    progress.emplace(
        *watch.progress, watch.terminal, fmt::format("{} seed {}", scenario.name, scenario.seed),
        source->size(),
        [&] { return fmt::format("{:.1f} MB", static_cast<double>(writer.bytes()) / kMegabyte); });
  }
  while (!watch.stopped || !watch.stopped()) {
    const std::optional<Sample> sample = source->next();
    if (!sample) break;
    writer.on_tick(*sample, {});
    if (progress) progress->on_tick(*sample, {});
  }
  writer.on_finish({});
  if (progress) progress->on_finish({});
  outcome.frames += writer.frames();
  outcome.bytes += writer.bytes();
  outcome.interrupted = writer.frames() < source->size();
  if (!outcome.interrupted) ++outcome.sequences;
}

/// The card of the folder that holds the sequences, and the formats' lists of them all.
void write_whole(const RecordRequest& request, const std::vector<std::string>& sequences,
                 const DatasetCard& of_first, bool complete) {
  std::vector<std::string> listed;
  for (const std::string& name : request.options.formats) {
    const DatasetFormat& format = format_named(name);
    if (complete && format.joined.join) {
      std::vector<std::string> parts;
      for (const std::string& sequence : sequences) parts.push_back(sequence + "/" + name);
      format.joined.join(request.out, parts, request.options);
    }
    for (const std::string& file : format.joined.files) {
      std::error_code ignored;
      if (fs::exists(request.out / file, ignored)) listed.push_back(file);
    }
  }
  DatasetCard card = of_first;
  card.sequences = sequences;
  card.complete = complete;
  card.frames = card.planned_frames = 0;
  for (const std::string& sequence : sequences) {
    const DatasetCard part = read_card(request.out / sequence);
    card.frames += part.frames;
    card.planned_frames += part.planned_frames;
  }
  FileManifest manifest(request.out);
  for (const std::string& sequence : sequences) {
    listed.push_back(sequence + "/" + DatasetCard::kName);
  }
  std::vector<ListedFile> files;
  for (const std::string& name : listed) {
    files.push_back({name, xxh128(read_file(request.out / name))});
  }
  manifest.add(files);
  card.files = manifest.files();
  card.files_xxh128 = xxh128(read_file(request.out / FileManifest::kName));
  write_card(request.out, card);
}

RecordOutcome record_one(const RecordRequest& request, const RecordWatch& watch) {
  RecordOutcome outcome;
  const ScenarioConfig scenario = scenario_of(request, std::nullopt);
  if (request.resume &&
      has_sequence(request.out, settings_hash(notes_of(scenario), request.options))) {
    outcome.sequences = outcome.skipped = 1;
    return outcome;
  }
  record_sequence(scenario, request.machine.plant_cache, request.out, request.options, watch,
                  outcome);
  return outcome;
}

}  // namespace

RecordOutcome record_dataset(const RecordRequest& request, const RecordWatch& watch) {
  if (!request.seeds) return record_one(request, watch);
  const auto [first, last] = *request.seeds;
  if (!request.resume) claim_folder(request.out);
  RecordOutcome outcome;
  std::vector<std::string> sequences;
  for (std::int64_t seed = first; seed <= last && !outcome.interrupted; ++seed) {
    const ScenarioConfig scenario = scenario_of(request, seed);
    const fs::path folder = request.out / name_of_sequence(seed);
    RecordOptions options = request.options;
    options.sequence = seed - first;
    sequences.push_back(name_of_sequence(seed));
    if (request.resume && has_sequence(folder, settings_hash(notes_of(scenario), options))) {
      ++outcome.sequences;
      ++outcome.skipped;
      continue;
    }
    record_sequence(scenario, request.machine.plant_cache, folder, options, watch, outcome);
  }
  const bool complete = outcome.sequences == last - first + 1;
  write_whole(request, sequences, read_card(request.out / sequences.front()), complete);
  return outcome;
}

}  // namespace vinebench::harness
