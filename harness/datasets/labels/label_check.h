// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/geometry/pose.h"
#include "core/time.h"
#include "harness/datasets/dataset_check.h"

namespace vinebench::harness {

/// A line of frames.csv.
struct RecordedPose {
  Stamp stamp = 0;
  Pose T_world_body;
};

struct LabelCheck {
  std::vector<DatasetFault> faults;
  std::int64_t images = 0;  ///< that were looked at
};

/// Holds the label images of some frames of a sequence against each other and against
/// calibration.yaml, as far as their formats are there:
///   sizes                 those of the calibration
///   depth, depth32        within half a millimetre; none where semantic says sky, else some
///   disparity             focal length · baseline / depth within its own steps and depth's
///   instances, semantic   bunches are where bunches are
///   flow                  of things at rest, where the depth's point is in the next frame: 0.1 px
///                         and what depth's steps make, at nine tenths of the pixels
///   coco                  masks, boxes, areas and panoptic images agree
LabelCheck check_labels(const std::filesystem::path& sequence,
                        const std::vector<RecordedPose>& frames);

}  // namespace vinebench::harness
