// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/format/format_writer.h"
#include "harness/datasets/labels/image_labels.h"

namespace vinebench::harness {

struct CocoOptions {
  ImageKind kind = ImageKind::kPng;
  std::set<Category> categories;    ///< of instances.json; all things if empty
  std::int64_t least_area = 0;      ///< px, of instances.json; smaller things are left out
  std::int64_t first_image_id = 1;  ///< distinct for the sequences of a data set
};

/// COCO: images/, instances.json (box, mask RLE, visibility and truncation for every thing; a
/// plant's leaves and canes are crowds), panoptic.json with panoptic/. During the recording the
/// lists are in files of one JSON object on each line (*.jsonl).
class CocoWriter : public FormatWriter {
 public:
  CocoWriter(const std::filesystem::path& folder, const RecordingNotes& notes,
             const SceneIndex& scene, const CocoOptions& options);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;
  void commit(const DatasetFrame& frame) override;
  void finish() override;

 private:
  /// The list items of a camera's image, computed in parallel and appended in order.
  struct Lines {
    std::string image;
    std::string annotations;
    std::string panoptic;
  };
  Lines describe(const DatasetFrame& frame, std::size_t camera, const ImageLabels& labels) const;
  std::string name_of_image(const DatasetFrame& frame, std::size_t camera,
                            const std::string& ending) const;

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  const SceneIndex& scene_;
  CocoOptions options_;
  AppendFile images_;
  AppendFile annotations_;
  AppendFile panoptic_;
  std::vector<Lines> pending_;  ///< of the current frame, by camera
};

/// Numbers of the images of a camera: frame by frame, camera by camera.
std::int64_t coco_image_id(const CocoOptions& options, std::int64_t frame, std::size_t camera);

/// Upper bound of the image ids of one sequence; the next one begins there.
inline constexpr std::int64_t kCocoImagesPerSequence = 10'000'000;

}  // namespace vinebench::harness
