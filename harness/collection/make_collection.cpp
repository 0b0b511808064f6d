// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/collection/make_collection.h"

#include <fmt/format.h>

#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/jobs/simulation_versions.h"
#include "harness/run/hash_environment.h"
#include "harness/sets/child_process.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kInterrupted = "interrupted";

RecordRequest record_request(const CollectionRequest& request, const CollectionSequence& sequence,
                             int threads) {
  RecordRequest record;
  record.scenario = sequence.scenario;
  record.overrides.assign(request.set.begin(), request.set.end());
  record.overrides.insert(record.overrides.end(), sequence.set.begin(), sequence.set.end());
  record.overrides.emplace_back("seed", fmt::format("{}", sequence.seed.value()));
  record.machine = request.machine;
  record.out = request.out / sequence.split / sequence.name;
  record.options = request.options;
  record.options.threads = threads;
  record.untrusted = request.untrusted;
  record.resume = true;
  return record;
}

/// In a child process.
std::string make(const RecordRequest& record, const std::function<bool()>& stopped) {
  const RecordOutcome outcome = record_dataset(record, {nullptr, false, stopped});
  if (outcome.interrupted) return kInterrupted;
  Json json{{"hash", read_card(record.out).frames_xxh128}};
  if (outcome.skipped == 0) {
    const ScenarioConfig scenario = load_scenario(record.scenario, record.overrides);
    json["environment"] = hash_environment(drawing_libraries(scenario.simulation.renderer));
  }
  return json_text(json);
}

}  // namespace

std::vector<MadeSequence> make_sequences(const CollectionRequest& request) {
  std::vector<MadeSequence> made(request.sequences.size());
  const int threads = std::max(1, request.threads / std::max(1, request.jobs));
  std::size_t done = 0;
  run_in_children(
      {.count = made.size(),
       .at_once = request.jobs,
       .name = [&](std::size_t i) { return request.sequences[i].name; },
       .job =
           [&](std::size_t i) {
             return make(record_request(request, request.sequences[i], threads), request.stopped);
           },
       .done =
           [&](std::size_t i, const ChildOutcome& child) {
             MadeSequence& sequence = made[i];
             if (child.ok && child.text != kInterrupted) {
               const Json json = Json::parse(child.text);
               json.at("hash").get_to(sequence.hash);
               if (json.contains("environment")) {
                 sequence.environment = json["environment"].get<NamedValues>();
               }
             } else if (!child.ok) {
               sequence.error = child.text;
             }
             ++done;
             if (request.progress == nullptr) return;
             const SequenceVerdict verdict = judge_sequence(request.sequences[i], sequence);
             *request.progress << fmt::format("[{}/{}] {}: {}", done, made.size(),
                                              request.sequences[i].name, text_of(verdict))
                               << (sequence.error.empty() ? "" : ", " + sequence.error)
                               << std::endl;
           },
       .stopped = request.stopped});
  return made;
}

SequenceVerdict judge_sequence(const CollectionSequence& sequence, const MadeSequence& made) {
  if (!made.error.empty()) return SequenceVerdict::kError;
  if (made.hash.empty()) return SequenceVerdict::kMissing;
  if (sequence.frames_xxh128.empty()) return SequenceVerdict::kNew;
  return made.hash == sequence.frames_xxh128 ? SequenceVerdict::kSame : SequenceVerdict::kDifferent;
}

const char* text_of(SequenceVerdict verdict) {
  switch (verdict) {
    case SequenceVerdict::kSame:
      return "the same frames";
    case SequenceVerdict::kNew:
      return "new";
    case SequenceVerdict::kDifferent:
      return "DIFFERENT frames";
    case SequenceVerdict::kError:
      return "ERROR";
    case SequenceVerdict::kMissing:
      return "missing";
  }
  return "";
}

}  // namespace vinebench::harness
