// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/run_hashes.h"

#include <gtest/gtest.h>

#include "tests/support/compared_runs.h"

namespace vinebench::harness {
namespace {

StoredRun hashed(const std::string& hash, const std::string& libm = "vinebench") {
  return {.scenario = "row", .json = test::hash_json(hash, libm)};
}

RunPair pair_of(const StoredRun& before, const StoredRun& after) {
  return {{.repeats = {before}}, {.repeats = {after}}};
}

TEST(RunHashesTest, RunsOfOneEnvironmentAreComparedByHash) {
  EXPECT_EQ(compare_hashes({hashed("a"), hashed("a")}).relation, HashRelation::kSame);
  const HashComparison other = compare_hashes({hashed("a"), hashed("a"), hashed("b")});
  EXPECT_EQ(other.relation, HashRelation::kDiffer);
  EXPECT_EQ(other.reason, "");
  EXPECT_EQ(compare_hashes({hashed("a"), StoredRun{}}).relation, HashRelation::kUnknown);
}

// Neither equal hashes nor different ones tell anything then.
TEST(RunHashesTest, OtherEnvironmentsAreNotComparable) {
  for (const char* hash : {"a", "b"}) {
    const HashComparison found = compare_hashes({hashed("a"), hashed(hash, "glibc")});
    EXPECT_EQ(found.relation, HashRelation::kNotComparable);
    EXPECT_EQ(found.reason, "their environments differ in libm");
  }
  StoredRun earlier = hashed("a");
  earlier.json.erase("hash_environment");
  EXPECT_EQ(compare_hashes({earlier, earlier}).reason, "a metrics.json has no hash_environment");
}

TEST(RunHashesTest, AProcessorIsNoDifference) {
  StoredRun other = hashed("a");
  other.json["hash_environment"]["processor"] = "another";
  EXPECT_EQ(compare_hashes({hashed("a"), other}).relation, HashRelation::kSame);
}

// Each pair may have been run somewhere else.
TEST(RunHashesTest, EachPairHasAnEnvironment) {
  const RunPair here = pair_of(hashed("a"), hashed("a"));
  const RunPair there = pair_of(hashed("b", "glibc"), hashed("b", "glibc"));
  EXPECT_EQ(compare_hashes({here, there}).relation, HashRelation::kSame);
  const RunPair differing = pair_of(hashed("a"), hashed("c"));
  EXPECT_EQ(compare_hashes({here, differing, there}).relation, HashRelation::kDiffer);
  EXPECT_EQ(compare_hashes({differing, pair_of(hashed("a"), {})}).relation, HashRelation::kUnknown);
  const RunPair mixed = pair_of(hashed("a"), hashed("a", "glibc"));
  EXPECT_EQ(compare_hashes({differing, mixed}).relation, HashRelation::kNotComparable);
}

}  // namespace
}  // namespace vinebench::harness
