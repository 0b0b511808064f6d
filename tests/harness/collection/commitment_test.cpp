// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/collection/commitment.h"

#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

// The digests of FIPS 180-2, appendix B.1, and of the empty message.
TEST(CommitmentTest, HashesAsTheStandardDoes) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

// printf 'salt:aisle-1:7' | sha256sum
TEST(CommitmentTest, CoversSaltSequenceAndSeed) {
  const std::string first = commitment_of("salt", "aisle-1", 7);
  EXPECT_EQ(first, sha256("salt:aisle-1:7"));
  EXPECT_NE(commitment_of("other", "aisle-1", 7), first);
  EXPECT_NE(commitment_of("salt", "aisle-2", 7), first);
  EXPECT_NE(commitment_of("salt", "aisle-1", 8), first);
}

TEST(CommitmentTest, SaltsAreOfTheirOwn) {
  EXPECT_EQ(random_salt().size(), 32u);
  EXPECT_NE(random_salt(), random_salt());
}

}  // namespace
}  // namespace vinebench::harness
