// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "harness/datasets/format/dataset_encoder.h"
#include "harness/datasets/format/recording_notes.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// Writes a run as one EurocWriter, without a data set's card around it. A replay of it gives the
/// run's estimate to the bit. A frame is in the lists once its images are whole, so that an
/// interrupted recording can be read.
class EurocSink : public Sink {
 public:
  /// Throws Error for a folder that is not empty or cannot be written to. Writing frames throws
  /// when the disk is full.
  EurocSink(const std::filesystem::path& folder, const RecordingNotes& notes);

  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;

 private:
  DatasetEncoder encoder_;
};

}  // namespace vinebench::harness
