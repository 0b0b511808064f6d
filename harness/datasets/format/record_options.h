// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/truth/frame_source.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/labels/label_table.h"

namespace vinebench::harness {

/// Which data of a run are recorded, and how.
struct RecordOptions {
  std::vector<std::string> formats{"euroc"};  ///< of parse_formats(); docs/datasets.md has them
  std::vector<std::string> cameras;           ///< names of the rig; all if empty
  std::set<Category> categories;              ///< of COCO's instances; all things if empty
  std::int64_t least_area = 0;  ///< px, of COCO's instances; smaller ones are left out
  std::int64_t first = 0;       ///< frame of the run
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;
  std::optional<ImageKind> images;  ///< default: PNG in rgb and coco, raw in ros
  bool colour = false;              ///< euroc, dcvslam, ros in colour; kitti in colour too
  int threads = 2;                  ///< for encoding, in addition to the simulation's
  std::int64_t sequence = 0;        ///< number of the sequence in its data set

  bool has(const std::string& format) const { return std::ranges::count(formats, format) > 0; }
  /// As text, for comparison when a recording is resumed.
  std::string text() const;
};

/// CapturePlan::cameras of these names; none if there are no names. `what` names the option in the
/// error. Throws Error for a camera that the rig does not have.
std::vector<bool> chosen_cameras(const std::vector<std::string>& names, const Rig& rig,
                                 const std::string& what);

/// "bunch,post" and so on: things. Throws Error that
/// lists what there is.
std::set<Category> parse_categories(const std::vector<std::string>& names);

/// "3..12" or "3": first and last. `what` names the option in the error.
std::pair<std::int64_t, std::int64_t> parse_span(const std::string& text, const std::string& what);

}  // namespace vinebench::harness
