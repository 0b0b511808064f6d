// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"

namespace vinebench::harness {

/// A sequence of a collection: what it is made from, and what its frames must be.
struct CollectionSequence {
  std::string name;                        ///< of its folder
  std::string split = "train";             ///< "train", "validation", "test", or any other
  std::string scenario;                    ///< a name, or a file relative to the collection's
  std::optional<std::int64_t> seed;        ///< none of one whose seed is secret
  std::string commitment;                  ///< then: commitment_of() it
  std::map<std::string, std::string> set;  ///< keys of the scenario, as --set
  std::string frames_xxh128;  ///< hash of its frames (DatasetCard); empty before it was made
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("split", split);
    archive("scenario", scenario);
    archive("seed", seed, Range::non_negative());
    archive("commitment", commitment);
    archive("set", set);
    archive("frames_xxh128", frames_xxh128);
    archive.require(is_folder_name(name), "name",
                    "expected a name that begins with no '.' and has no '/'");
    archive.require(is_folder_name(split), "split",
                    "expected a name that begins with no '.' and has no '/'");
    archive.require(!scenario.empty(), "scenario", "expected a scenario");
    archive.require(seed.has_value() == commitment.empty(), "seed",
                    "expected either a seed or a commitment");
  }

 private:
  static bool is_folder_name(const std::string& text) {
    return !text.empty() && !text.starts_with('.') && text.find('/') == std::string::npos;
  }
};

/// A data set as a recipe: anyone makes the same bytes from it.
struct Collection {
  std::string name;
  std::string description;
  std::string version;                             ///< of the program that made the hashes
  std::map<std::string, std::string> environment;  ///< what computed them (hash_environment.h)
  std::vector<std::string> formats{"euroc"};       ///< of a recording, by default
  std::map<std::string, std::string> set;  ///< keys of all scenarios, before a sequence's own
  std::vector<CollectionSequence> sequences;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("description", description);
    archive("version", version);
    archive("environment", environment);
    archive("formats", formats);
    archive("set", set);
    archive("sequences", sequences);
    archive.require(!name.empty(), "name", "expected a name");
    archive.require(!sequences.empty(), "sequences", "expected at least one");
  }
};

/// Seeds that are secret, and what hides them.
struct CollectionSecrets {
  std::string salt;
  std::map<std::string, std::int64_t> seeds;  ///< by the sequence's name
  template <class Archive>
  void serialize(Archive& archive) {
    archive("salt", salt);
    archive("seeds", seeds, Range::non_negative());
  }
};

/// Throws Error that names file, line and key; also for two sequences of one name.
Collection read_collection(const std::filesystem::path& file);
CollectionSecrets read_secrets(const std::filesystem::path& file);

/// The file of the collection, below the comments that `text`, the file as it is, begins with.
std::string format_collection(const Collection& collection, const std::string& text);

/// Takes the seeds of a split out of the collection, and leaves their commitments.
CollectionSecrets seal(Collection& collection, const std::string& split, const std::string& salt);

/// Puts seeds back. Throws Error for one that is not what was committed to.
void unseal(Collection& collection, const CollectionSecrets& secrets);

}  // namespace vinebench::harness
