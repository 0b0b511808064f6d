// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/truth/frame_source.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/labels/label_table.h"

namespace vinebench::harness {

/// In what form a run is recorded; docs/datasets.md says what each is and who reads it.
enum class RecordFormat {
  kEuroc,
  kKitti,
  kTum,
  kDcvslam,
  kRgb,
  kDepth,
  kDepth32,
  kDisparity,
  kFlow,
  kFlo,
  kNormals,
  kSemantic,
  kInstances,
  kCoco,
  kRos
};
inline std::vector<std::string> yaml_names(RecordFormat) {
  return {"euroc", "kitti", "tum",     "dcvslam",  "rgb",       "depth", "depth32", "disparity",
          "flow",  "flo",   "normals", "semantic", "instances", "coco",  "ros"};
}

/// What of a run is recorded, and how.
struct RecordOptions {
  std::set<RecordFormat> formats{RecordFormat::kEuroc};
  std::vector<std::string> cameras;  ///< names of the rig; all where empty
  std::set<Category> categories;     ///< of COCO's instances; all things where empty
  std::int64_t first = 0;            ///< frame of the run
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;
  std::optional<ImageKind> images;  ///< where absent, PNG in rgb and coco, raw in ros
  bool colour = false;              ///< euroc, dcvslam, ros in colour; kitti in colour too
  int threads = 2;                  ///< that encode, beside the simulation's
  std::int64_t sequence = 0;        ///< number of the sequence in its data set

  bool has(RecordFormat format) const { return formats.contains(format); }
  /// As text, for comparing a recording with one that is to be resumed.
  std::string text() const;
};

/// CapturePlan::cameras of these names; none where there are no names. `what` names the option in
/// the error. Throws Error for a camera that the rig has not.
std::vector<bool> chosen_cameras(const std::vector<std::string>& names, const Rig& rig,
                                 const std::string& what);

/// What the formats ask of the simulation. Throws Error for a camera that the rig has not.
CapturePlan plan_of(const RecordOptions& options, const Rig& rig);

/// Names of the formats that this program can write.
std::vector<std::string> all_formats();

/// "euroc,depth" and so on. Throws Error that lists what there is.
std::set<RecordFormat> parse_formats(const std::vector<std::string>& names);

/// "bunch,post" and so on: things. Throws likewise.
std::set<Category> parse_categories(const std::vector<std::string>& names);

/// "3..12" or "3": first and last. `what` names the option in the error.
std::pair<std::int64_t, std::int64_t> parse_span(const std::string& text, const std::string& what);

}  // namespace vinebench::harness
