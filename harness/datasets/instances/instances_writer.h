// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// Instances as RGB images, id = R + 256 G + 65536 B: a plant, post, tag, box or person has
/// RenderedImage::instances' own number (its low byte says which bunch), the rover 1, all else 0;
/// and instances.csv, which says what the numbers are.
class InstanceWriter : public FormatWriter {
 public:
  InstanceWriter(const std::filesystem::path& folder, const RecordingNotes& notes,
                 const SceneIndex& scene);
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  void name_new_ones(const cv::Mat& instances);

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  const SceneIndex& scene_;
  AppendFile table_;
  std::map<std::int32_t, std::int32_t> ids_;  ///< of every number seen so far
};

}  // namespace vinebench::harness
