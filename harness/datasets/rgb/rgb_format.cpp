// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/rgb/rgb_format.h"

#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/format/image_writer.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_rgb_writer(const WriterInputs& inputs) {
  const ImageKind kind = inputs.options.images.value_or(ImageKind::kPng);
  return std::make_unique<ImageWriter>(inputs.folder, inputs.notes, "rgb",
                                       yaml_names(kind).at(static_cast<std::size_t>(kind)),
                                       [kind](const DatasetFrame& frame, std::size_t camera) {
                                         return encode_image(frame.frame.images[camera], kind);
                                       });
}

}  // namespace

DatasetFormat rgb_format() {
  return {
      .name = "rgb", .description = "images as the cameras gave them", .write = make_rgb_writer};
}

}  // namespace vinebench::harness
