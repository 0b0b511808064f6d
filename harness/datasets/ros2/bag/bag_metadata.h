// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/datasets/ros2/mcap/mcap_writer.h"

namespace vinebench::harness {

/// The file by which ROS 2 knows a folder as a bag.
inline constexpr const char* kBagMetadata = "metadata.yaml";

// Names in our MCAP files: a record with the time of stamp 0, and ROS 2's of a topic's quality.
inline constexpr const char* kOurMetadata = "vinebench";
inline constexpr const char* kStartKey = "time_of_stamp_0";  // ns
inline constexpr const char* kQualityKey = "offered_qos_profiles";

/// How ROS 2 publishes a topic that is played: reliably; `latched` also to those who subscribe
/// later.
std::string quality_of_service(bool latched);

/// metadata.yaml, version 5 (ROS 2 Humble and later), of a bag of one MCAP file.
std::string format_bag_metadata(const std::string& file, const std::vector<McapChannel>& channels,
                                const McapStatistics& statistics);

/// The files of a bag in a folder: those that its metadata.yaml lists, else those that are there,
/// ordered by name; those of ROS 1 where there are none of ROS 2. Throws Error for a metadata.yaml
/// that cannot be used, for bags whose files are compressed as a whole, and names outside of the
/// folder.
std::vector<std::filesystem::path> bag_files(const std::filesystem::path& folder);

/// Whether a file, or a folder with such files or metadata.yaml, is a bag of ROS 2, by the names
/// alone.
bool is_bag(const std::filesystem::path& bag);

/// Likewise a bag of ROS 1.
bool is_ros1_bag(const std::filesystem::path& bag);

}  // namespace vinebench::harness
