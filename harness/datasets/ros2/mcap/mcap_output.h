// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "harness/datasets/ros2/cdr/ros2_output.h"
#include "harness/datasets/ros2/mcap/mcap_writer.h"

namespace vinebench::harness {

/// A bag of ROS 2 in a folder: an MCAP file and, when it is closed, metadata.yaml, by which ROS 2
/// and its tools read the folder.
class McapOutput : public Ros2Output {
 public:
  /// `start`, ns: what the times of messages are ahead of a recording's stamps, for our own reader.
  McapOutput(const std::filesystem::path& file, std::int64_t start);
  /// Closes it if possible.
  ~McapOutput() override;
  McapOutput(const McapOutput&) = delete;
  McapOutput& operator=(const McapOutput&) = delete;

  void end_chunk() override;
  void close() override;

 private:
  void put(Ros2Message message) override;

  std::filesystem::path file_;
  McapWriter out_;
  bool closed_ = false;
  std::map<std::string, std::size_t> channels_;  ///< by topic
};

}  // namespace vinebench::harness
