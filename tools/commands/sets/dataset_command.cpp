// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/catalogue/catalogue.h"
#include "harness/collection/commitment.h"
#include "harness/collection/make_collection.h"
#include "harness/datasets/formats.h"
#include "harness/run/hash_environment.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"
#include "vinebench/version.h"

namespace vinebench::tools {
namespace {

namespace fs = std::filesystem;

struct DatasetArguments {
  std::string file;
  std::string out;
  std::vector<std::string> formats;
  std::vector<std::string> splits;
  std::vector<std::string> only;
  std::string secrets;
  std::string seal;
  bool write = false;
  bool list = false;
  int jobs = 1;
  int threads = default_threads();
  std::filesystem::path cache;
  bool untrusted = false;
  Surroundings surroundings;
};

/// Those that the options ask for; all without any.
std::vector<harness::CollectionSequence> chosen(const harness::Collection& collection,
                                                const DatasetArguments& arguments) {
  std::vector<harness::CollectionSequence> sequences;
  const auto has = [](const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::ranges::count(list, name) > 0;
  };
  for (const harness::CollectionSequence& sequence : collection.sequences) {
    if (has(arguments.splits, sequence.split) && has(arguments.only, sequence.name)) {
      sequences.push_back(sequence);
    }
  }
  for (const std::string& name : arguments.only) {
    if (std::ranges::none_of(sequences,
                             [&](const auto& sequence) { return sequence.name == name; })) {
      fail("{}: --only: there is no sequence {}", arguments.file, name);
    }
  }
  if (sequences.empty()) {
    fail("{}: no sequence of split {}", arguments.file, fmt::join(arguments.splits, ", "));
  }
  return sequences;
}

/// With all settings, those that the sequences share first.
void list(const harness::Collection& collection,
          const std::vector<harness::CollectionSequence>& sequences) {
  for (const harness::CollectionSequence& sequence : sequences) {
    std::string text;
    for (const auto& settings : {collection.set, sequence.set}) {
      for (const auto& [key, value] : settings) text += fmt::format(" {}={}", key, value);
    }
    fmt::print("{:<24} {:<10} {} seed {}{}\n", sequence.name, sequence.split, sequence.scenario,
               sequence.seed ? std::to_string(*sequence.seed) : "secret", text);
  }
}

/// Where the same program computes otherwise, this is why.
std::string difference_of(const harness::Collection& collection,
                          const std::vector<harness::MadeSequence>& made) {
  if (collection.environment.empty()) return "";
  const NamedValues before(collection.environment.begin(), collection.environment.end());
  for (const harness::MadeSequence& sequence : made) {
    if (sequence.environment.empty()) continue;
    const std::string names = harness::environment_differences(before, sequence.environment);
    if (!names.empty()) return names;
  }
  return "";
}

void write_hashes(harness::Collection collection,
                  const std::vector<harness::CollectionSequence>& sequences,
                  const std::vector<harness::MadeSequence>& made, const fs::path& file) {
  std::map<std::string, std::string> hashes;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!made[i].hash.empty()) hashes[sequences[i].name] = made[i].hash;
    const NamedValues& environment = made[i].environment;
    if (!environment.empty()) {
      collection.environment = {environment.begin(), environment.end()};
      collection.environment.erase("processor");  // of which the hash does not depend
    }
  }
  collection.version = kVersion;
  for (harness::CollectionSequence& sequence : collection.sequences) {
    const auto found = hashes.find(sequence.name);
    if (found != hashes.end()) sequence.frames_xxh128 = found->second;
  }
  write_file_atomically(file, harness::format_collection(collection, read_file(file)));
}

int seal(harness::Collection collection, const DatasetArguments& arguments) {
  if (arguments.splits.size() != 1) fail("--seal: expected one --split, whose seeds become secret");
  const std::string& split = arguments.splits.front();
  std::error_code ignored;
  if (fs::exists(arguments.seal, ignored)) {
    fail("{}: exists; secrets are not written over others", arguments.seal);
  }
  const harness::CollectionSecrets secrets =
      harness::seal(collection, split, harness::random_salt());
  if (secrets.seeds.empty()) fail("{}: no sequence of split {} has a seed", arguments.file, split);
  write_file_atomically(arguments.seal, format_yaml(secrets));
  write_file_atomically(arguments.file,
                        harness::format_collection(collection, read_file(arguments.file)));
  fmt::print("{}: {} seeds are in {} alone\n", arguments.file, secrets.seeds.size(),
             arguments.seal);
  return 0;
}

harness::CollectionRequest request_of(const DatasetArguments& arguments,
                                      const harness::Collection& collection) {
  harness::CollectionRequest request;
  for (harness::CollectionSequence& sequence : request.sequences = chosen(collection, arguments)) {
    if (!sequence.seed) {
      fail("sequence {}: its seed is secret; expected --secrets FILE, or another --split",
           sequence.name);
    }
    sequence.scenario = arguments.surroundings.catalogue
                            .find(harness::DataKind::kScenario,
                                  harness::beside_or_name(arguments.file, sequence.scenario))
                            .string();
  }
  request.set = collection.set;
  request.options.formats =
      harness::parse_formats(arguments.formats.empty() ? collection.formats : arguments.formats);
  request.machine = with_cache(arguments.surroundings.machine, arguments.cache);
  if (arguments.untrusted) {
    request.untrusted = harness::Untrusted{arguments.surroundings.data_folders};
  }
  request.out = arguments.out.empty() ? fs::path("out") / collection.name : fs::path(arguments.out);
  request.jobs = arguments.jobs;
  request.threads = arguments.threads;
  request.progress = &std::cerr;
  request.stopped = interrupted;
  return request;
}

int dataset(const DatasetArguments& arguments) {
  harness::Collection collection = harness::read_collection(arguments.file);
  if (!arguments.seal.empty()) return seal(collection, arguments);
  const harness::Collection published = collection;
  if (!arguments.secrets.empty()) {
    harness::unseal(collection, harness::read_secrets(arguments.secrets));
  }
  if (arguments.list) {
    list(collection, chosen(collection, arguments));
    return 0;
  }
  const harness::CollectionRequest request = request_of(arguments, collection);
  catch_interrupts();
  const FolderLock lock(request.out);
  const std::vector<harness::MadeSequence> made = harness::make_sequences(request);
  if (arguments.write) write_hashes(published, request.sequences, made, arguments.file);
  std::map<harness::SequenceVerdict, int> count;
  for (std::size_t i = 0; i < made.size(); ++i) {
    ++count[harness::judge_sequence(request.sequences[i], made[i])];
  }
  std::vector<std::string> parts;
  for (const auto& [verdict, number] : count) {
    parts.push_back(fmt::format("{} {}", number, harness::text_of(verdict)));
  }
  fmt::print("{}: {} sequences: {}\n", request.out.string(), made.size(), fmt::join(parts, ", "));
  if (count[harness::SequenceVerdict::kDifferent] > 0) {
    const std::string names = difference_of(collection, made);
    fmt::print("made by version {}, here {}{}\n", collection.version, kVersion,
               names.empty() ? "" : "; what computes here is another: " + names);
  }
  if (interrupted()) return interruption_code();
  if (count[harness::SequenceVerdict::kError] > 0) return kBadInput;
  return count[harness::SequenceVerdict::kDifferent] > 0 && !arguments.write ? kExpectationFailed
                                                                             : 0;
}

}  // namespace

Command dataset_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<DatasetArguments>();
  arguments->surroundings = surroundings;
  return {
      .name = "dataset",
      .description = "Make the sequences of a data set from its recipe, and compare them by hash",
      .options =
          {{.name = "FILE",
            .target = &arguments->file,
            .help = "A recipe (YAML): sequences with scenario, seed, settings and hash",
            .required = true,
            .existing = Existing::kFile},
           {.name = "--out",
            .target = &arguments->out,
            .help = "Folder for the data sets, each in <split>/<sequence> (default: out/<name>)",
            .type = "FOLDER"},
           {.name = "--format",
            .target = &arguments->formats,
            .help = "Formats in place of the recipe's, as of record; the hashes are the same",
            .commas = true},
           {.name = "--split",
            .target = &arguments->splits,
            .help = "Only sequences of these splits, such as train,validation",
            .commas = true},
           {.name = "--only",
            .target = &arguments->only,
            .help = "Only the sequences of these names",
            .commas = true},
           {.name = "--list",
            .target = &arguments->list,
            .help = "Print the sequences, and make none"},
           {.name = "--write",
            .target = &arguments->write,
            .help = "Write the hashes of what was made into the recipe"},
           {.name = "--seal",
            .target = &arguments->seal,
            .help = "Take the seeds of one --split out of the recipe into this file, and leave "
                    "their commitments",
            .type = "FILE"},
           {.name = "--secrets",
            .target = &arguments->secrets,
            .help = "File of --seal, with the seeds that the recipe keeps secret",
            .type = "FILE",
            .existing = Existing::kFile},
           {.name = "--jobs",
            .target = &arguments->jobs,
            .help = "Sequences side by side, which share the threads",
            .show_default = true,
            .range = Range::between(1, 256)},
           threads_option(arguments->threads),
           cache_option(arguments->cache),
           untrusted_option(arguments->untrusted)},
      .footer =
          "Exit code: 0 when all sequences have the frames that the recipe tells, 1 when they "
          "have others, 2 for bad input and where one cannot be made, 130 when interrupted. The "
          "same command goes on.",
      .run = [arguments] { return dataset(*arguments); }};
}

}  // namespace vinebench::tools
