// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/catalogue/catalogue.h"

#include <algorithm>
#include <system_error>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "core/util/suggestion.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

/// Where the entries of a kind are, relative to a data folder.
struct Place {
  fs::path folder;
  std::string file_name;  ///< of every entry, which its folder names; any *.yaml where empty
  fs::path without{};     ///< a sub-folder that has another kind
};

Place place_of(DataKind kind) {
  switch (kind) {
    case DataKind::kScenario:
      return {"scenarios", "", "randomisation"};
    case DataKind::kWorld:
      return {"worlds", ""};
    case DataKind::kRover:
      return {"models", "rover.yaml"};
    case DataKind::kRig:
      return {"models", "rig.yaml"};
    case DataKind::kRandomisation:
      return {"scenarios/randomisation", ""};
  }
  fail("no kind of data: {}", static_cast<int>(kind));
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The files of a place in a data folder: those of the folder itself first, then by sub-folder.
std::vector<fs::path> files_of(const fs::path& folder, const Place& place) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder / place.folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const fs::path& path = entry->path();
    if (!place.without.empty() && path.filename() == place.without) {
      entry.disable_recursion_pending();
    }
    const bool wanted =
        place.file_name.empty() ? path.extension() == ".yaml" : path.filename() == place.file_name;
    if (wanted && is_file(path)) files.push_back(path);
  }
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
    return std::tuple(depth(a), a) < std::tuple(depth(b), b);
  });
  return files;
}

std::string entry_name(const fs::path& file, const Place& place) {
  return place.file_name.empty() ? file.stem().string() : file.parent_path().filename().string();
}

std::string without_quotes(std::string text) {
  if (text.size() > 1 && (text.front() == '"' || text.front() == '\'') &&
      text.back() == text.front()) {
    text = text.substr(1, text.size() - 2);
  }
  return text;
}

/// Up to the first ". " or ": ", without a full stop.
std::string first_sentence(const std::string& text) {
  const std::size_t end = std::min(text.find(". "), text.find(": "));
  if (end != std::string::npos) return text.substr(0, end);
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

}  // namespace

const char* name_of(DataKind kind) {
  constexpr const char* kNames[] = {"scenario", "world", "rover", "rig", "randomisation"};
  return kNames[static_cast<int>(kind)];
}

Catalogue::Catalogue(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (!error && std::ranges::count(folders_, real) == 0) folders_.push_back(real);
  }
}

fs::path Catalogue::find(DataKind kind, const std::string& text) const {
  if (is_file(text)) return text;
  for (const fs::path& folder : folders_) {
    if (is_file(folder / text)) return folder / text;
  }
  std::vector<std::string> names;
  for (const DataEntry& entry : list(kind)) {
    if (entry.name == text) return entry.file;
    names.push_back(entry.name);
  }
  const fs::path path = text;
  const std::string word =
      path.has_parent_path() || path.extension() == ".yaml" ? path.stem().string() : text;
  fail("{}: neither a file nor the name of a {}{}", text, name_of(kind), did_you_mean(word, names));
}

std::vector<DataEntry> Catalogue::list(DataKind kind) const {
  const Place place = place_of(kind);
  std::vector<DataEntry> entries;
  for (const fs::path& folder : folders_) {
    for (const fs::path& file : files_of(folder, place)) {
      const std::string name = entry_name(file, place);
      if (std::ranges::find(entries, name, &DataEntry::name) == entries.end()) {
        entries.push_back({name, file, describe_file(file)});
      }
    }
  }
  return entries;
}

std::vector<fs::path> data_folders(const fs::path& program) {
  std::vector<fs::path> folders = program_data_folders(program);
  folders.insert(folders.begin(), ".");
  return folders;
}

std::vector<fs::path> program_data_folders(const fs::path& program) {
  const fs::path folder = program.parent_path();
  std::vector<fs::path> folders{folder / "../share/vinebench"};
  if (is_file(folder / "data_folder.txt")) {
    InputStream note(folder / "data_folder.txt", FileKind::kTable);
    if (std::string line; std::getline(note, line)) folders.emplace_back(line);
  }
  return folders;
}

namespace {

std::string description_in(std::istream& in) {
  std::string comment;
  bool comment_ended = false;
  for (std::string line; std::getline(in, line);) {
    constexpr std::string_view kKey = "description: ";
    if (line.starts_with(kKey)) return without_quotes(line.substr(kKey.size()));
    const bool text = line.starts_with("# ") && !line.starts_with("# SPDX");
    if (text && !comment_ended) {
      if (!comment.empty()) comment += ' ';
      comment.append(line, 2);
    }
    comment_ended = comment_ended || (!text && !comment.empty());
  }
  return first_sentence(comment);
}

}  // namespace

std::string beside_or_name(const std::filesystem::path& file, const std::string& text) {
  std::error_code ignored;
  const std::filesystem::path beside = std::filesystem::absolute(file).parent_path() / text;
  const bool there = std::filesystem::is_regular_file(beside, ignored);
  return there ? beside.lexically_normal().string() : text;
}

std::string describe_file(const fs::path& file) {
  try {
    InputStream in(file, FileKind::kYaml);
    return description_in(in);
  } catch (const Error&) {  // a file that cannot be read hides no other entry of the list
    return "";
  }
}

}  // namespace vinebench::harness
