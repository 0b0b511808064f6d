// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/collection/commitment.h"

#include <fmt/format.h>
#include <openssl/sha.h>
#include <sys/random.h>

#include <array>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

template <std::size_t N>
std::string digits_of(const std::array<unsigned char, N>& bytes) {
  std::string digits;
  for (const unsigned char byte : bytes) digits += fmt::format("{:02x}", byte);
  return digits;
}

}  // namespace

std::string sha256(const std::string& bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  return digits_of(digest);
}

std::string commitment_of(const std::string& salt, const std::string& sequence, std::int64_t seed) {
  return sha256(fmt::format("{}:{}:{}", salt, sequence, seed));
}

std::string random_salt() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    fail("the system has no random numbers");
  }
  return digits_of(bytes);
}

}  // namespace vinebench::harness
