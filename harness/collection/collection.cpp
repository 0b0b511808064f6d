// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/collection/collection.h"

#include <fmt/format.h>

#include <set>
#include <sstream>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/util/error.h"
#include "harness/collection/commitment.h"

namespace vinebench::harness {

Collection read_collection(const std::filesystem::path& file) {
  auto collection = YamlDocument::load(file).read<Collection>();
  std::set<std::string> names;
  for (const CollectionSequence& sequence : collection.sequences) {
    if (!names.insert(sequence.name).second) {
      fail("{}: two of the sequences have the name '{}'; expected unique names", file.string(),
           sequence.name);
    }
  }
  return collection;
}

CollectionSecrets read_secrets(const std::filesystem::path& file) {
  return YamlDocument::load(file).read<CollectionSecrets>();
}

std::string format_collection(const Collection& collection, const std::string& text) {
  std::string comments;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && (line.empty() || line.starts_with('#'));) {
    comments += line + "\n";
  }
  return comments + format_yaml(collection);
}

CollectionSecrets seal(Collection& collection, const std::string& split, const std::string& salt) {
  CollectionSecrets secrets{salt, {}};
  for (CollectionSequence& sequence : collection.sequences) {
    if (sequence.split != split || !sequence.seed) continue;
    secrets.seeds[sequence.name] = *sequence.seed;
    sequence.commitment = commitment_of(salt, sequence.name, *sequence.seed);
    sequence.seed.reset();
  }
  return secrets;
}

void unseal(Collection& collection, const CollectionSecrets& secrets) {
  for (CollectionSequence& sequence : collection.sequences) {
    const auto found = secrets.seeds.find(sequence.name);
    if (found == secrets.seeds.end() || sequence.seed) continue;
    if (commitment_of(secrets.salt, sequence.name, found->second) != sequence.commitment) {
      fail("sequence {}: seed {} is not the one that was committed to", sequence.name,
           found->second);
    }
    sequence.seed = found->second;
    sequence.commitment.clear();
  }
}

}  // namespace vinebench::harness
