// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "harness/datasets/format/dataset_encoder.h"
#include "harness/datasets/format/recording_notes.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// Writes a run with one EurocWriter, without dataset.yaml. A replay of it gives the run's estimate
/// bit by bit. A frame is listed once its images are complete, so that an interrupted recording can
/// be read.
class EurocSink : public Sink {
 public:
  /// Throws Error for a folder that is not empty or cannot be written to. Writing frames throws if
  /// the disk is full.
  EurocSink(const std::filesystem::path& folder, const RecordingNotes& notes);

  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;

 private:
  DatasetEncoder encoder_;
};

}  // namespace vinebench::harness
