// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/depth32/depth32_format.h"

#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/format/image_writer.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_depth32_writer(const WriterInputs& inputs) {
  return std::make_unique<ImageWriter>(inputs.folder, inputs.notes, "depth32", "npy",
                                       [](const DatasetFrame& frame, std::size_t camera) {
                                         return encode_npy(truth_of(frame, camera).depth);
                                       });
}

}  // namespace

DatasetFormat depth32_format() {
  return {.name = "depth32",
          .description = "depth, NumPy arrays of float32 in m, 0 for sky",
          .truth = {.depth = true},
          .write = make_depth32_writer};
}

}  // namespace vinebench::harness
