// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/normals/normals_format.h"

#include "harness/datasets/files/png_writer.h"
#include "harness/datasets/format/image_writer.h"
#include "harness/datasets/labels/truth_colours.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_normals_writer(const WriterInputs& inputs) {
  return std::make_unique<ImageWriter>(
      inputs.folder, inputs.notes, "normals", "png",
      [](const DatasetFrame& frame, std::size_t camera) {
        return encode_png(colour_normals(truth_of(frame, camera).normals));
      });
}

}  // namespace

DatasetFormat normals_format() {
  return {.name = "normals",
          .description = "surface normals, PNG in colours",
          .truth = {.normals = true},
          .write = make_normals_writer};
}

}  // namespace vinebench::harness
