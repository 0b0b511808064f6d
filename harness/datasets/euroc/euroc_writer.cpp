// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_writer.h"

#include "harness/datasets/euroc/euroc_format.h"
#include "harness/datasets/format/dataset_folder.h"

namespace vinebench::harness {
namespace {

constexpr int kThreads = 1;

DatasetEncoder::Formats euroc_alone(const std::filesystem::path& folder,
                                    const RecordingNotes& notes) {
  DatasetEncoder::Formats formats;
  formats.push_back(std::make_unique<EurocFormat>(claim_folder(folder), notes, false));
  return formats;
}

}  // namespace

EurocWriter::EurocWriter(const std::filesystem::path& folder, const RecordingNotes& notes)
    : encoder_(euroc_alone(folder, notes), kThreads) {}

void EurocWriter::on_tick(const Sample& sample, const Estimate&) {
  encoder_.submit(own_frame(sample, sample.frame.index));
}

void EurocWriter::on_finish(const SlamSummary&) {
  encoder_.finish();
}

}  // namespace vinebench::harness
