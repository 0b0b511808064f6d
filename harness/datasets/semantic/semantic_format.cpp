// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/semantic/semantic_format.h"

#include "core/files/files.h"
#include "harness/datasets/files/png_writer.h"
#include "harness/datasets/format/image_writer.h"
#include "harness/datasets/labels/label_table.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_semantic_writer(const WriterInputs& inputs) {
  make_folder(inputs.folder);
  write_file_atomically(inputs.folder / "labels.yaml", label_table_text());
  return std::make_unique<ImageWriter>(inputs.folder, inputs.notes, "semantic", "png",
                                       [](const DatasetFrame& frame, std::size_t camera) {
                                         return encode_png(truth_of(frame, camera).labels);
                                       });
}

}  // namespace

DatasetFormat semantic_format() {
  return {.name = "semantic",
          .description = "labels, 8-bit PNG of numbers, with a table of names",
          .truth = {.labels = true},
          .write = make_semantic_writer,
          .check_image = [](LabelImages& images) { images.read("semantic", CV_8UC1); }};
}

}  // namespace vinebench::harness
