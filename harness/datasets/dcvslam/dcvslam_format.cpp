// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dcvslam/dcvslam_format.h"

#include "harness/datasets/dcvslam/dcvslam_writer.h"

namespace vinebench::harness {

DatasetFormat dcvslam_format() {
  return {.name = "dcvslam",
          .description = "images, configuration and tags for DC-VSLAM's programs",
          .write = [](const WriterInputs& inputs) {
            return std::make_unique<DcvslamWriter>(inputs.folder, inputs.notes,
                                                   inputs.options.colour);
          }};
}

}  // namespace vinebench::harness
