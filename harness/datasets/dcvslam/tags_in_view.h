// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// A tag that is completely in a tag camera's image, with its true pose.
struct TagInView {
  std::size_t camera = 0;  ///< of the data set
  WorldTag tag;
  Pose T_cam_tag;
  /// Bottom left first, then anticlockwise on the printed face, px.
  std::array<Eigen::Vector2d, 4> corners;
};

/// The tags of Truth::visible_tags, by camera.
std::vector<TagInView> tags_in_view(const DatasetFrame& frame, const RecordingNotes& notes);

}  // namespace vinebench::harness
