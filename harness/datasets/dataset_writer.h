// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "harness/datasets/format/dataset_card.h"
#include "harness/datasets/format/dataset_encoder.h"
#include "harness/datasets/format/record_options.h"
#include "harness/run/run_hash.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// Records a run of a scenario as one sequence: one folder for each format; beside them frames.csv
/// (number, frame of the run, stamp and true pose), calibration.yaml (the true cameras),
/// scenario.resolved.yaml, the list of files and dataset.yaml.
class DatasetWriter : public Sink {
 public:
  /// Throws Error for a folder that is not empty or cannot be written to, an unknown camera, and
  /// formats that are incompatible with the rig. The source must outlive the writer.
  DatasetWriter(const std::filesystem::path& folder, const RecordingNotes& notes,
                const SimulatedSource& source, const RecordOptions& options, std::int64_t planned);

  /// Frames not selected by the options are skipped. Throws if the disk is full; what has been
  /// written remains readable.
  void on_tick(const Sample& sample, const Estimate& estimate) override;
  /// The number of frames determines whether the recording is complete.
  void on_finish(const SlamSummary& summary) override;

  std::int64_t frames() const { return frames_; }
  std::uint64_t bytes() const { return encoder_->bytes(); }

 private:
  void begin(const RecordingNotes& notes, const SceneIndex& scene);
  DatasetEncoder::Writers make_writers(const RecordingNotes& notes, const SceneIndex& scene) const;
  DatasetFrame frame_of(const Sample& sample) const;

  std::filesystem::path folder_;
  RecordOptions options_;
  CapturePlan plan_;
  std::vector<std::size_t> cameras_;  ///< of the rig
  DatasetCard card_;
  std::unique_ptr<FileManifest> manifest_;
  RunHash frames_hash_;
  std::int64_t frames_ = 0;
  std::unique_ptr<DatasetEncoder> encoder_;
};

/// The card of a recording that has begun.
DatasetCard initial_card(const RecordingNotes& notes, const RecordOptions& options, const Rig& rig,
                         std::int64_t planned);

/// Removes what an interrupted recording left, not the folder: its lists first and its card last,
/// so that another interruption leaves something to check and to resume. Throws Error.
void clear_recording(const std::filesystem::path& folder);

/// Hash of all inputs of a recording.
std::string settings_hash(const RecordingNotes& notes, const RecordOptions& options);

}  // namespace vinebench::harness
