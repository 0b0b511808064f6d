// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/config/yaml.h"
#include "core/files/input_file.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRoot = "rosbag2_bagfile_information";

/// A text of several lines as a value of YAML in double quotes.
std::string quoted(const std::string& text) {
  std::string value = "\"";
  for (const char c : text) value += c == '\n' ? std::string("\\n") : std::string(1, c);
  return value + "\"";
}

std::string text_of(const YAML::Node& node) {
  return node.IsDefined() && node.IsScalar() ? node.Scalar() : "";
}

bool is_ros2_file(const fs::path& file) {
  return file.extension() == ".mcap" || file.extension() == ".db3";
}

bool is_ros1_file(const fs::path& file) {
  return file.extension() == ".bag";
}

std::vector<fs::path> files_in(const fs::path& folder, bool (*wanted)(const fs::path&)) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (wanted(entry.path())) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// The path of a file that metadata.yaml lists; early versions of ROS 2 put the folder before it.
fs::path listed_file(const fs::path& folder, const std::string& name) {
  const fs::path listed(name);
  if (name.empty() || listed.is_absolute() || std::ranges::count(listed, fs::path("..")) > 0) {
    fail("{}: relative_file_paths: expected names of files in the folder, found '{}'",
         (folder / kBagMetadata).string(), name);
  }
  return is_present(folder / listed) ? folder / listed : folder / listed.filename();
}

}  // namespace

std::string quality_of_service(bool latched) {
  const std::string forever = "  {}:\n    sec: 9223372036\n    nsec: 854775807\n";
  std::string text = "- history: 1\n";
  text += fmt::format("  depth: {}\n", latched ? 1 : 10);
  text += fmt::format("  reliability: 1\n  durability: {}\n", latched ? 1 : 2);
  for (const char* key : {"deadline", "lifespan"}) text += fmt::format(fmt::runtime(forever), key);
  text += "  liveliness: 1\n";
  text += fmt::format(fmt::runtime(forever), "liveliness_lease_duration");
  return text + "  avoid_ros_namespace_conventions: false";
}

std::string format_bag_metadata(const std::string& file, const std::vector<McapChannel>& channels,
                                const McapStatistics& statistics) {
  const std::uint64_t duration = statistics.last_time - statistics.first_time;
  std::string text = fmt::format(
      "{}:\n  version: 5\n  storage_identifier: mcap\n  duration:\n    nanoseconds: {}\n"
      "  starting_time:\n    nanoseconds_since_epoch: {}\n  message_count: {}\n"
      "  topics_with_message_count:\n",
      kRoot, duration, statistics.first_time, statistics.messages);
  for (const McapChannel& channel : channels) {
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        channel.topic, channel.schema, quoted(channel.metadata.at(kQualityKey)), channel.messages);
  }
  text += fmt::format(
      "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - {0}\n"
      "  files:\n    - path: {0}\n      starting_time:\n        nanoseconds_since_epoch: {1}\n"
      "      duration:\n        nanoseconds: {2}\n      message_count: {3}\n",
      file, statistics.first_time, duration, statistics.messages);
  return text;
}

std::vector<fs::path> bag_files(const fs::path& folder) {
  const fs::path metadata = folder / kBagMetadata;
  std::vector<fs::path> files = files_in(folder, is_ros2_file);
  if (is_ros1_bag(folder) && !is_bag(folder)) files = files_in(folder, is_ros1_file);
  if (is_present(metadata)) {
    const YAML::Node bag = load_yaml_tree(metadata)[kRoot];
    if (!bag.IsDefined() || !bag.IsMap()) fail("{}: expected a map {}", metadata.string(), kRoot);
    std::string mode = text_of(bag["compression_mode"]);
    std::ranges::transform(mode, mode.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!mode.empty() && mode != "none") {
      fail(
          "{}: expected a bag that is not compressed, found compression_mode {}: `ros2 bag "
          "convert` or `zstd -d` make one (compression inside of MCAP files is read)",
          metadata.string(), mode);
    }
    const YAML::Node listed = bag["relative_file_paths"];
    if (listed.IsDefined() && listed.IsSequence() && listed.size() > 0) {
      files.clear();
      for (const YAML::Node& file : listed) files.push_back(listed_file(folder, text_of(file)));
    }
  }
  if (files.empty()) fail("{}: expected .mcap, .db3 or .bag files, found none", folder.string());
  return files;
}

bool is_bag(const fs::path& bag) {
  std::error_code ignored;
  if (fs::is_directory(bag, ignored)) {
    return is_present(bag / kBagMetadata) || !files_in(bag, is_ros2_file).empty();
  }
  return is_ros2_file(bag);
}

bool is_ros1_bag(const fs::path& bag) {
  std::error_code ignored;
  return fs::is_directory(bag, ignored) ? !files_in(bag, is_ros1_file).empty() : is_ros1_file(bag);
}

}  // namespace vinebench::harness
