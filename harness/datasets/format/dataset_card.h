// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config_field.h"

namespace vinebench::harness {

/// dataset.yaml: the description of one sequence, or of a folder of several.
struct DatasetCard {
  static constexpr const char* kName = "dataset.yaml";

  std::string name;
  std::string made_by;  ///< program and version
  std::string licence = "CC0 1.0 (public domain dedication)";
  std::string scenario;
  std::string world;
  std::int64_t seed = 0;
  std::vector<std::string> sequences;  ///< folders below this one, each with its own dataset.yaml
  bool complete = false;               ///< false during the recording, and after an interruption
  std::vector<std::string> formats;
  std::vector<std::string> cameras;
  std::int64_t frames = 0;
  std::int64_t planned_frames = 0;
  std::int64_t files = 0;    ///< in the list of files
  std::string files_xxh128;  ///< hash of that list, which has the hash of every file
  /// Hash of all frames, images, readings and true poses, whatever the formats; of one sequence.
  std::string frames_xxh128;
  std::string settings_xxh128;  ///< hash of scenario.resolved.yaml and of the options
  std::string units = "m, s, rad, px; times of files in ns since the scenario's start";
  std::string frames_and_axes =
      "world: x east, y north, z up. body: x ahead, y left, z up. cameras: x right, y down, z "
      "ahead. pixel (0, 0) is the centre of the top left pixel";

  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("made_by", made_by);
    archive("licence", licence);
    archive("scenario", scenario);
    archive("world", world);
    archive("seed", seed, Range::non_negative());
    archive("sequences", sequences);
    archive("complete", complete);
    archive("formats", formats);
    archive("cameras", cameras);
    archive("frames", frames, Range::non_negative());
    archive("planned_frames", planned_frames, Range::non_negative());
    archive("files", files, Range::non_negative());
    archive("files_xxh128", files_xxh128);
    archive("frames_xxh128", frames_xxh128);
    archive("settings_xxh128", settings_xxh128);
    archive("units", units);
    archive("frames_and_axes", frames_and_axes);
  }
};

/// Throws Error that names file, line and key.
DatasetCard read_card(const std::filesystem::path& folder);

void write_card(const std::filesystem::path& folder, const DatasetCard& card);

bool has_card(const std::filesystem::path& folder);

/// Whether a recording was interrupted before it had its card: the card, which is written first, is
/// incomplete and there is nothing else.
bool has_partial_card_alone(const std::filesystem::path& folder);

}  // namespace vinebench::harness
