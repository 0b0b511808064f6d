// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_output.h"

#include <utility>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/ros2/bag/bag_metadata.h"
#include "harness/datasets/ros2/cdr/ros2_schemas.h"
#include "vinebench/version.h"

namespace vinebench::harness {

McapOutput::McapOutput(const std::filesystem::path& file, std::int64_t start)
    : file_(file), out_(file, fmt::format("vinebench {}", kVersion)) {
  out_.write_metadata(kOurMetadata, {{kStartKey, std::to_string(start)}});
}

McapOutput::~McapOutput() {
  try {
    close();
  } catch (const Error&) {  // the error was reported before
  }
}

void McapOutput::put(Ros2Message message) {
  const auto [channel, first] = channels_.try_emplace(message.topic, 0);
  if (first) {
    channel->second =
        out_.add_channel({.topic = message.topic,
                          .schema = message.type,
                          .schema_text = ros2_schema(message.type),
                          .metadata = {{kQualityKey, quality_of_service(message.latched)}}});
  }
  out_.write(channel->second, static_cast<std::uint64_t>(message.time), message.bytes);
}

void McapOutput::end_chunk() {
  out_.end_chunk();
}

void McapOutput::close() {
  if (std::exchange(closed_, true)) return;
  out_.close();
  write_file_atomically(
      file_.parent_path() / kBagMetadata,
      format_bag_metadata(file_.filename().string(), out_.channels(), out_.statistics()));
}

}  // namespace vinebench::harness
