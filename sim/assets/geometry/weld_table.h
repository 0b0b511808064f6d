// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace vinebench::sim {

/// Numbers items by their bytes, in the order in which they first come; equal items have one
/// number. T is without padding. Takes 8 to 16 bytes an item beside the item itself.
template <class T>
class WeldTable {
 public:
  std::uint32_t index_of(const T& item) {
    if (2 * (items_.size() + 1) > slots_.size()) grow();
    std::uint32_t& slot = slot_of(item);
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(items_.size());
      items_.push_back(item);
    }
    return slot;
  }

  const std::vector<T>& items() const { return items_; }
  /// Leaves the table empty.
  std::vector<T> take() {
    slots_ = {};
    return std::exchange(items_, {});
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

  static std::uint64_t hash(const T& item) {
    static_assert(sizeof(T) % sizeof(std::uint32_t) == 0);
    std::uint64_t sum = 0;
    for (std::size_t at = 0; at < sizeof(T); at += sizeof(std::uint32_t)) {
      std::uint32_t word = 0;
      std::memcpy(&word, reinterpret_cast<const char*>(&item) + at, sizeof(word));
      sum = (sum ^ word) * 0x9e3779b97f4a7c15ULL;
      sum ^= sum >> 29;
    }
    return sum;
  }

  std::uint32_t& slot_of(const T& item) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(item) & mask;
    while (slots_[at] != kEmpty && std::memcmp(&items_[slots_[at]], &item, sizeof(T)) != 0) {
      at = (at + 1) & mask;
    }
    return slots_[at];
  }

  void grow() {
    const std::size_t size = slots_.empty() ? 64 : 2 * slots_.size();
    slots_.assign(size, kEmpty);
    for (std::uint32_t i = 0; i < items_.size(); ++i) slot_of(items_[i]) = i;
  }

  std::vector<T> items_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace vinebench::sim
