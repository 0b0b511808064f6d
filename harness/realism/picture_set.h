// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/util/worker_pool.h"
#include "harness/datasets/files/json_file.h"
#include "harness/realism/picture_statistics.h"

namespace vinebench::harness {

/// One picture of a set, reduced to numbers.
struct MeasuredPicture {
  std::string name;
  std::string group;  ///< pictures of one group resemble each other: a photographer, a world's seed
  std::filesystem::path file;  ///< empty if only its numbers are known
  PictureStatistics statistics;
};

/// Pictures of one kind, all scaled to one width.
struct PictureSet {
  std::string name;
  int width = 752;  ///< px
  std::vector<MeasuredPicture> pictures;

  /// The values of a statistic, of those that have it.
  std::vector<double> values(const std::string& statistic) const;
  /// The names of all statistics, in the order of the first picture that has each.
  std::vector<std::string> statistics() const;
};

/// Measures every picture (.jpg, .jpeg, .png) of a folder, at that width. Those of a sub-folder are
/// a group; the group of others is their own name. Throws Error for a folder without pictures, and
/// for a picture that cannot be read.
PictureSet measure_folder(const std::filesystem::path& folder, int width, WorkerPool& pool);

/// A set's numbers alone, without its pictures, so that they can be compared with where the
/// pictures may not go.
nlohmann::ordered_json to_json(const PictureSet& set);
/// Throws Error that names the file if it is none of these.
PictureSet read_picture_set(const std::filesystem::path& file);

}  // namespace vinebench::harness
