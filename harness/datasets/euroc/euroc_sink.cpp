// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_sink.h"

#include "harness/datasets/euroc/euroc_writer.h"
#include "harness/datasets/files/dataset_folder.h"

namespace vinebench::harness {
namespace {

constexpr int kThreads = 1;

DatasetEncoder::Writers euroc_alone(const std::filesystem::path& folder,
                                    const RecordingNotes& notes) {
  DatasetEncoder::Writers formats;
  formats.push_back(std::make_unique<EurocWriter>(claim_folder(folder), notes, false));
  return formats;
}

}  // namespace

EurocSink::EurocSink(const std::filesystem::path& folder, const RecordingNotes& notes)
    : encoder_(euroc_alone(folder, notes), kThreads) {}

void EurocSink::on_tick(const Sample& sample, const Estimate&) {
  encoder_.submit(own_frame(sample, sample.frame.index));
}

void EurocSink::on_finish(const SlamSummary&) {
  encoder_.finish();
}

}  // namespace vinebench::harness
