// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/flow/flow_format.h"

#include "harness/datasets/flow/flow_check.h"
#include "harness/datasets/flow/flow_writer.h"

namespace vinebench::harness {

namespace {

constexpr TruthImages kFlowTruth{.labels = true, .depth = true, .normals = true, .motion = true};

std::unique_ptr<FormatWriter> write_flow_images(const WriterInputs& inputs) {
  const bool both = inputs.options.has("flo");
  const std::filesystem::path flo = inputs.folder.parent_path() / "flo";
  return std::make_unique<FlowWriter>(
      FlowWriter::Folders{inputs.folder, both ? flo : std::filesystem::path()}, inputs.notes);
}

std::unique_ptr<FormatWriter> write_flo(const WriterInputs& inputs) {
  if (inputs.options.has("flow")) return nullptr;
  return std::make_unique<FlowWriter>(FlowWriter::Folders{{}, inputs.folder}, inputs.notes);
}

}  // namespace

DatasetFormat flow_format() {
  return {.name = "flow",
          .description = "flow to the next frame, 16-bit PNG (KITTI), with visibility",
          .truth = kFlowTruth,
          .looks_back = true,
          .write = write_flow_images,
          .check_image = check_flow_image};
}

DatasetFormat flo_format() {
  return {.name = "flo",
          .description = "flow to the next frame, .flo (Middlebury)",
          .truth = kFlowTruth,
          .looks_back = true,
          .write = write_flo};
}

}  // namespace vinebench::harness
