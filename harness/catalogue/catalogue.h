// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vinebench::harness {

/// A kind of file that comes with the program and has a name: `scenarios/quick-loop.yaml` is the
/// scenario quick-loop, `models/csl-rover/rig.yaml` the rig csl-rover.
enum class DataKind { kScenario, kWorld, kRover, kRig, kRandomisation };

/// "scenario", "world", ...
const char* name_of(DataKind kind);

struct DataEntry {
  std::string name;
  std::filesystem::path file;
  std::string description;  ///< one line; empty where the file has none
};

/// The scenarios, worlds, rovers and rigs of some data folders, each of which may have the
/// sub-folders scenarios, worlds and models. A name in an earlier folder hides it in later ones.
class Catalogue {
 public:
  Catalogue() = default;
  /// Folders that do not exist, or are named twice, are left out.
  explicit Catalogue(const std::vector<std::filesystem::path>& folders);

  /// The file that a text means: a file relative to the working directory, else relative to a data
  /// folder, else that of the entry of this name. Throws Error with the nearest name.
  std::filesystem::path find(DataKind kind, const std::string& text) const;

  /// Sorted by sub-folder, then by name.
  std::vector<DataEntry> list(DataKind kind) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// What a file means by the text: a file beside it if there is one, else the text itself, a name.
std::string beside_or_name(const std::filesystem::path& file, const std::string& text);

/// Where the data of a program is: in the working directory, in `../share/vinebench` of the
/// program's folder (installed), and in the folder that `data_folder.txt` beside the program names
/// (as built).
std::vector<std::filesystem::path> data_folders(const std::filesystem::path& program);

/// The same without the working directory.
std::vector<std::filesystem::path> program_data_folders(const std::filesystem::path& program);

/// The value of a file's `description:`, else the first sentence of its first comment that is not
/// the licence; empty where it has neither.
std::string describe_file(const std::filesystem::path& file);

}  // namespace vinebench::harness
