// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_output.h"

#include <utility>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/ros2/bag/bag_metadata.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"
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

void McapOutput::put(const std::string& topic, const char* type, std::int64_t time,
                     const std::string& message, bool latched) {
  const auto [channel, first] = channels_.try_emplace(topic, 0);
  if (first) {
    channel->second = out_.add_channel({.topic = topic,
                                        .schema = type,
                                        .schema_text = ros2_schema(type),
                                        .metadata = {{kQualityKey, quality_of_service(latched)}}});
  }
  out_.write(channel->second, static_cast<std::uint64_t>(time), message);
}

void McapOutput::write_clock(const std::string& topic, std::int64_t time) {
  put(topic, ros2::kClock, time, encode_clock(time));
}

void McapOutput::write_transforms(const std::string& topic,
                                  const std::vector<RosTransform>& transforms) {
  if (transforms.empty()) return;
  put(topic, ros2::kTransforms, transforms.front().header.time, encode(transforms));
}

void McapOutput::write_latched(const std::string& topic,
                               const std::vector<RosTransform>& transforms) {
  if (transforms.empty()) return;
  put(topic, ros2::kTransforms, transforms.front().header.time, encode(transforms), true);
}

void McapOutput::write(const std::string& topic, const RosImage& image) {
  put(topic, ros2::kImage, image.header.time, encode(image));
}

void McapOutput::write(const std::string& topic, const RosCompressedImage& image) {
  put(topic, ros2::kCompressedImage, image.header.time, encode(image));
}

void McapOutput::write(const std::string& topic, const RosCameraInfo& info) {
  put(topic, ros2::kCameraInfo, info.header.time, encode(info));
}

void McapOutput::write(const std::string& topic, const RosImu& reading) {
  put(topic, ros2::kImu, reading.header.time, encode(reading));
}

void McapOutput::write(const std::string& topic, const RosJointState& reading) {
  put(topic, ros2::kJointState, reading.header.time, encode(reading));
}

void McapOutput::write(const std::string& topic, const RosOdometry& odometry) {
  put(topic, ros2::kOdometry, odometry.header.time, encode(odometry));
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
