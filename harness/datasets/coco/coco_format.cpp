// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/coco/coco_format.h"

#include "harness/datasets/coco/coco_check.h"
#include "harness/datasets/coco/coco_file.h"
#include "harness/datasets/coco/coco_writer.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_coco_writer(const WriterInputs& inputs) {
  const RecordOptions& options = inputs.options;
  return std::make_unique<CocoWriter>(
      inputs.folder, inputs.notes, inputs.scene,
      CocoOptions{options.images.value_or(ImageKind::kPng), options.categories, options.least_area,
                  options.sequence * kCocoImagesPerSequence + 1});
}

void check_coco_lists(const RecordedSequence& sequence, std::vector<DatasetFault>& faults) {
  if (!sequence.has("coco/panoptic.json")) return;  // the last file; interrupted
  for (const DatasetFault& fault : check_coco(sequence.folder / "coco")) {
    faults.push_back({"coco/" + fault.file, fault.problem});
  }
}

void join_coco(const std::filesystem::path& folder, const std::vector<std::string>& parts,
               const RecordOptions& options) {
  merge_coco(folder, parts, options.categories);
}

}  // namespace

DatasetFormat coco_format() {
  return {.name = "coco",
          .description = "COCO: boxes, masks, visibility and panoptic images",
          .truth = {.labels = true, .instances = true},
          .write = make_coco_writer,
          .check = check_coco_lists,
          .joined = {{"instances.json", "panoptic.json"}, join_coco}};
}

}  // namespace vinebench::harness
