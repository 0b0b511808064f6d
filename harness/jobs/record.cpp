// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/record.h"

#include <fmt/format.h>

#include <system_error>

#include "core/files/files.h"
#include "core/util/error.h"
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

/// The quality's keys, then what the request sets itself.
std::vector<Override> overrides_of(const RecordRequest& request) {
  std::vector<Override> overrides;
  if (request.quality != sim::RenderQuality::kFast) {
    sim::RendererConfig renderer;
    sim::choose_quality(renderer, request.quality);
    overrides.emplace_back("renderer.lod_scale", fmt::format("{}", renderer.lod_scale));
    overrides.emplace_back("renderer.supersampling", fmt::format("{}", renderer.supersampling));
  }
  overrides.insert(overrides.end(), request.overrides.begin(), request.overrides.end());
  return overrides;
}

ScenarioConfig scenario_of(const RecordRequest& request, std::optional<std::int64_t> seed) {
  ScenarioConfig scenario =
      load_drawn_scenario(request.scenario, overrides_of(request), request.randomisation, seed);
  if (request.untrusted) check_untrusted(scenario, request.scenario, *request.untrusted);
  sim::choose_backend(scenario.simulation.renderer, request.machine.gl_platform);
  return scenario;
}

/// Whether the folder has this sequence, complete. Removes an interrupted one.
bool has_sequence(const fs::path& folder, const std::string& settings) {
  if (has_partial_card_alone(folder)) clear_folder(folder);
  if (!has_card(folder)) return false;
  const DatasetCard card = read_card(folder);
  if (!card.sequences.empty()) {
    fail("recording {}: has several sequences; expected the same --seeds to resume",
         folder.string());
  }
  if (card.settings_xxh128 != settings) {
    fail("recording {}: was made with other settings; expected the same to resume",
         folder.string());
  }
  if (card.complete) return true;
  clear_recording(folder);
  return false;
}

/// One sequence; adds to the outcome.
void record_sequence(const ScenarioConfig& scenario, const CacheFolder& plant_cache,
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
    progress.emplace(*watch.progress, watch.terminal,
                     fmt::format("{} seed {}", scenario.name, scenario.seed), source->size(), [&] {
                       return fmt::format("{:.1f} MB of images",
                                          static_cast<double>(writer.bytes()) / kMegabyte);
                     });
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
  outcome.bytes += bytes_below(folder);
  outcome.interrupted = writer.frames() < source->size();
  if (!outcome.interrupted) ++outcome.sequences;
}

/// The folder of several sequences, and what it has beside them.
class SequenceFolder {
 public:
  SequenceFolder(const RecordRequest& request, std::vector<std::string> sequences, DatasetCard card)
      : request_(request), sequences_(std::move(sequences)), card_(std::move(card)) {
    card_.sequences = sequences_;
  }

  /// Makes it, or finds it as an interrupted recording left it. Its card says what it will have.
  void begin() {
    if (has_card(request_.out)) check_same(read_card(request_.out));
    make_folder(request_.out);
    remove_unfinished(request_.out);
    write_card(request_.out, card_);
    std::error_code ignored;  // it would have hashes of cards that change now
    fs::remove(request_.out / FileManifest::kName, ignored);
  }

  /// Its card and list, and where all sequences are complete the formats' lists of them all.
  void finish(bool complete) {
    std::vector<std::string> listed;
    for (const std::string& name : request_.options.formats) {
      const JoinedLists& joined = format_named(name).joined;
      if (complete && joined.join) joined.join(request_.out, parts_of(name), request_.options);
      for (const std::string& file : joined.files) {
        std::error_code ignored;
        if (fs::exists(request_.out / file, ignored)) listed.push_back(file);
      }
    }
    for (const std::string& sequence : sequences_) {
      if (!has_card(request_.out / sequence)) continue;
      const DatasetCard part = read_card(request_.out / sequence);
      card_.frames += part.frames;
      card_.planned_frames += part.planned_frames;
      listed.push_back(sequence + "/" + DatasetCard::kName);
    }
    write_list(listed);
    card_.complete = complete;
    write_card(request_.out, card_);
  }

 private:
  void check_same(const DatasetCard& existing) const {
    if (existing.sequences.empty()) {
      fail("recording {}: is one sequence; expected no --seeds to resume", request_.out.string());
    }
    if (existing.settings_xxh128 != card_.settings_xxh128) {
      fail(
          "recording {}: was made with other settings or from another seed on; expected the same "
          "to resume",
          request_.out.string());
    }
    if (existing.sequences.size() > sequences_.size()) {
      fail("recording {}: has {} sequences; expected --seeds with at least these to resume",
           request_.out.string(), existing.sequences.size());
    }
  }

  std::vector<std::string> parts_of(const std::string& format) const {
    std::vector<std::string> parts;
    for (const std::string& sequence : sequences_) parts.push_back(sequence + "/" + format);
    return parts;
  }

  void write_list(const std::vector<std::string>& names) {
    std::vector<ListedFile> files;
    for (const std::string& name : names) {
      files.push_back({name, xxh128(read_file(request_.out / name))});
    }
    FileManifest manifest(request_.out);
    manifest.add(files);
    card_.files = manifest.files();
    card_.files_xxh128 = xxh128(read_file(request_.out / FileManifest::kName));
  }

  const RecordRequest& request_;
  std::vector<std::string> sequences_;
  DatasetCard card_;
};

/// Locks the folder of a request; it must be empty unless the recording is resumed.
FolderLock prepare_folder(const RecordRequest& request) {
  FolderLock lock = lock_recording(request.out);
  if (!request.resume) claim_folder(request.out);
  return lock;
}

RecordOutcome record_one(const RecordRequest& request, const RecordWatch& watch) {
  RecordOutcome outcome;
  const ScenarioConfig scenario = scenario_of(request, std::nullopt);
  const FolderLock lock = prepare_folder(request);
  if (request.resume &&
      has_sequence(request.out, settings_hash(notes_of(scenario), request.options))) {
    outcome.sequences = outcome.skipped = 1;
    return outcome;
  }
  record_sequence(scenario, request.machine.plant_cache, request.out, request.options, watch,
                  outcome);
  return outcome;
}

SequenceFolder folder_of(const RecordRequest& request) {
  const auto [first, last] = *request.seeds;
  std::vector<std::string> names;
  for (std::int64_t seed = first; seed <= last; ++seed) names.push_back(name_of_sequence(seed));
  const ScenarioConfig scenario = scenario_of(request, first);
  const Rig rig = load_rig(scenario.simulation.rover.rig);
  return {request, std::move(names), initial_card(notes_of(scenario), request.options, rig, 0)};
}

RecordOutcome record_sequences(const RecordRequest& request, const RecordWatch& watch) {
  const auto [first, last] = *request.seeds;
  SequenceFolder whole = folder_of(request);
  const FolderLock lock = prepare_folder(request);
  whole.begin();
  RecordOutcome outcome;
  for (std::int64_t seed = first; seed <= last && !outcome.interrupted; ++seed) {
    const ScenarioConfig scenario = scenario_of(request, seed);
    const fs::path folder = make_folder(request.out / name_of_sequence(seed));
    RecordOptions options = request.options;
    options.sequence = seed - first;
    if (request.resume && has_sequence(folder, settings_hash(notes_of(scenario), options))) {
      ++outcome.sequences;
      ++outcome.skipped;
      continue;
    }
    try {
      record_sequence(scenario, request.machine.plant_cache, folder, options, watch, outcome);
    } catch (const Error&) {
      if (!request.resume && seed == first && !has_card(folder)) clear_folder(request.out);
      throw;
    }
  }
  whole.finish(outcome.sequences == last - first + 1);
  return outcome;
}

}  // namespace

RecordOutcome record_dataset(const RecordRequest& request, const RecordWatch& watch) {
  if (!request.seeds) return record_one(request, watch);
  return record_sequences(request, watch);
}

}  // namespace vinebench::harness
