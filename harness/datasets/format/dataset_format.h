// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/datasets/format/format_writer.h"
#include "harness/datasets/format/label_images.h"
#include "harness/datasets/format/record_options.h"
#include "harness/datasets/format/recorded_sequence.h"
#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// The inputs of a writer.
struct WriterInputs {
  std::filesystem::path folder;  ///< of this format alone: <data set>/<name>
  const RecordingNotes& notes;   ///< of the selected cameras
  const SceneIndex& scene;
  const RecordOptions& options;
};

/// Truth images required by a writer; a simulation renders no others.
struct TruthImages {
  bool labels = false;
  bool depth = false;
  bool normals = false;
  bool motion = false;
  bool instances = false;
};

/// Reads a format; the first three are set, or none.
struct FormatReader {
  std::string layout;  ///< what it recognises, for error messages: "an EuRoC folder (mav0)"
  std::function<bool(const std::filesystem::path& folder)> recognises;
  /// Without the ground truth where the options name another. Throws Error.
  std::function<Recording(const std::filesystem::path& folder, const RecordingOptions& options)>
      read;
  bool topics = false;  ///< whether cameras can be chosen by RecordingOptions::topics
};

/// Lists that a data set of several sequences has of them all, in its own folder.
struct JoinedLists {
  std::vector<std::string> files;  ///< by name
  /// Creates them in `folder` from those of the sequences in `parts`, relative to it.
  std::function<void(const std::filesystem::path& folder, const std::vector<std::string>& parts,
                     const RecordOptions& options)>
      join;
};

/// The descriptor of a data set format. Members that do not apply are empty.
struct DatasetFormat {
  std::string name;         ///< for the option --format, and of its folder in a data set
  std::string description;  ///< one line, human-readable
  TruthImages truth{};
  bool available = true;  ///< whether this build can write it
  /// Its files of a frame can be written when the next one is there: they come after the others'.
  bool looks_back = false;
  /// Throws Error for a rig or options that do not go with the format. May return nothing where
  /// another requested format writes its files.
  std::function<std::unique_ptr<FormatWriter>(const WriterInputs&)> write;
  FormatReader reader{};
  /// Compares the format's lists with the frames of its sequence; adds faults.
  std::function<void(const RecordedSequence&, std::vector<DatasetFault>&)> check{};
  /// Holds one label image against its calibration and other formats' images.
  std::function<void(LabelImages&)> check_image{};
  JoinedLists joined{};
};

}  // namespace vinebench::harness
