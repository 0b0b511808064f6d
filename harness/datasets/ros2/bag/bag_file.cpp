// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_file.h"

#include "core/util/error.h"
#include "harness/datasets/ros2/bag/sqlite_file.h"
#include "harness/datasets/ros2/mcap/mcap_file.h"

namespace vinebench::harness {

std::unique_ptr<BagFile> open_bag_file(const std::filesystem::path& file) {
  if (file.extension() == ".mcap") return std::make_unique<McapFile>(file);
  if (file.extension() == ".db3") return std::make_unique<SqliteFile>(file);
  fail("{}: expected a name that ends in .mcap or .db3", file.string());
}

}  // namespace vinebench::harness
