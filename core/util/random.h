// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace vinebench {

/// Counter-based randomness: every draw is a function of (seed, stream name, frame, index) only, so
/// that an additional sensor, plant or thread changes no other draw.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name, std::uint64_t frame = 0);

  /// 64 hashed bits for that index (SplitMix64's finaliser over a Weyl sequence).
  std::uint64_t bits(std::uint64_t index) const {
    std::uint64_t z = key_ + (index + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// Uniform in [0, 1), 53 bits.
  double uniform(std::uint64_t index) const {
    return static_cast<double>(bits(index) >> 11) * 0x1.0p-53;
  }
  double uniform(std::uint64_t index, double low, double high) const {
    return low + (high - low) * uniform(index);
  }

  /// Standard normal (Box-Muller on two halves of the index's own bits).
  double normal(std::uint64_t index) const;

 private:
  std::uint64_t key_;
};

/// A stream read in sequence, for generators that draw an unknown number of values.
class RandomSequence {
 public:
  explicit RandomSequence(RandomStream stream) : stream_(stream) {}
  double uniform(double low = 0, double high = 1) { return stream_.uniform(next_++, low, high); }
  double normal(double mean = 0, double sigma = 1) {
    return mean + sigma * stream_.normal(next_++);
  }
  /// Uniform integer in [0, n).
  int below(int n) { return static_cast<int>(stream_.uniform(next_++) * n); }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

/// FNV-1a of bytes, continued from `hash`; used for stream names and run hashes.
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325ULL);

}  // namespace vinebench
