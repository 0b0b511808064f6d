// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/random.h"

#include <cmath>
#include <numbers>

namespace vinebench {
namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 33)) * 0xff51afd7ed558ccdULL;
  z = (z ^ (z >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return z ^ (z >> 33);
}

}  // namespace

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash) {
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return hash;
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view name, std::uint64_t frame)
    : key_(mix(mix(mix(seed + 0x9e3779b97f4a7c15ULL) ^ fnv1a(name)) +
               frame * 0xd1342543de82ef95ULL)) {}

double RandomStream::normal(std::uint64_t index) const {
  const std::uint64_t b = bits(index);
  const double u1 = (static_cast<double>(b >> 32) + 0.5) * 0x1.0p-32;
  const double u2 = static_cast<double>(b & 0xffffffffULL) * 0x1.0p-32;
  return std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * std::numbers::pi * u2);
}

}  // namespace vinebench
