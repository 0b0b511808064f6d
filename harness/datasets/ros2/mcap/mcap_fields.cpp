// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_fields.h"

#include "core/util/error.h"

namespace vinebench::harness {

McapFields& McapFields::put_map(const McapMap& map) {
  McapFields inner;
  for (const auto& [key, value] : map) inner.put_text(key).put_text(value);
  return put_text(inner.bytes());
}

std::string McapFields::record(McapRecord kind) const {
  McapFields record;
  record.put(static_cast<std::uint8_t>(kind)).put(std::uint64_t{bytes_.size()}).put_bytes(bytes_);
  return std::move(record.bytes_);
}

std::string_view McapFieldReader::take(std::uint64_t size) {
  if (size > rest_.size()) {
    fail("{}: expected {} more bytes in the record, found {}", where_, size, rest_.size());
  }
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

McapMap McapFieldReader::get_map() {
  McapFieldReader inner(get_text(), where_);
  McapMap map;
  while (!inner.rest().empty()) {
    const std::string key(inner.get_text());
    map[key] = std::string(inner.get_text());
  }
  return map;
}

}  // namespace vinebench::harness
