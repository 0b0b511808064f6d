// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "core/util/arithmetic.h"
#include "harness/collection/collection.h"
#include "harness/jobs/record.h"

namespace vinebench::harness {

/// What of a collection is made, and how.
struct CollectionRequest {
  std::vector<CollectionSequence> sequences;  ///< each with its seed, scenarios as files
  std::map<std::string, std::string> set;     ///< of all
  std::filesystem::path out;                  ///< OUT/<split>/<name>
  RecordOptions options;                      ///< but the threads
  Machine machine;
  std::optional<Untrusted> untrusted{};
  int jobs = 1;
  int threads = 1;                  ///< of all jobs together
  std::function<bool()> stopped{};  ///< polled; may be empty
  std::ostream* progress = nullptr;
};

/// A sequence that was made, or was there.
struct MadeSequence {
  std::string hash{};         ///< of its frames; empty if it could not be made
  std::string error{};        ///< why not; empty if it was not reached
  NamedValues environment{};  ///< what computed it; of those that were made now
};

/// Records them, each in a process of its own; complete ones are kept, interrupted ones recorded
/// again. Returns as many, in their order.
std::vector<MadeSequence> make_sequences(const CollectionRequest& request);

/// What became of a sequence beside what the collection says of it.
enum class SequenceVerdict { kSame, kNew, kDifferent, kError, kMissing };
SequenceVerdict judge_sequence(const CollectionSequence& sequence, const MadeSequence& made);

/// "the same frames", "new", ...
const char* text_of(SequenceVerdict verdict);

}  // namespace vinebench::harness
