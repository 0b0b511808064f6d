// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/file_manifest.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 32;
constexpr std::string_view kBetween = "  ";
constexpr std::size_t kPart = std::size_t{1} << 20;  // bytes of a file in memory

std::string digits_of(const XXH128_hash_t& hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string line_of(const ListedFile& file) {
  return fmt::format("{}{}{}\n", file.hash, kBetween, file.name);
}

bool is_line(std::string_view line) {
  return line.size() > kDigits + kBetween.size() && line.substr(kDigits, 2) == kBetween &&
         line.substr(0, kDigits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace

std::string xxh128(std::string_view bytes) {
  return digits_of(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string xxh128_of_file(const fs::path& file) {
  InputFile in(file, FileKind::kPart);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> part(kPart);
  for (std::size_t count = part.size(); count == part.size();) {
    count = in.read(part.data(), part.size());
    XXH3_128bits_update(state.get(), part.data(), count);
  }
  return digits_of(XXH3_128bits_digest(state.get()));
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code ignored;  // a loop of links is no file
    if (it->is_regular_file(ignored))
      names.push_back(it->path().lexically_relative(folder).string());
  }
  if (error) fail("{}: cannot be read: {}", folder.string(), error.message());
  std::ranges::sort(names);
  return names;
}

std::uint64_t bytes_below(const fs::path& folder) {
  std::uint64_t bytes = 0;
  std::set<std::pair<dev_t, ino_t>> counted;
  for (const std::string& name : files_below(folder)) {
    struct stat status {};
    if (stat((folder / name).c_str(), &status) != 0) continue;
    const bool first = status.st_nlink == 1 || counted.emplace(status.st_dev, status.st_ino).second;
    if (first) bytes += static_cast<std::uint64_t>(status.st_size);
  }
  return bytes;
}

FileManifest::FileManifest(const fs::path& folder) : folder_(folder), list_(folder / kName) {}

void FileManifest::add(const std::vector<ListedFile>& files) {
  std::string lines;
  for (const ListedFile& file : files) {
    lines += line_of(file);
    names_.push_back(file.name);
  }
  list_.append(lines);
}

void FileManifest::add_rest(const std::vector<std::string>& without) {
  std::set<std::string> known(names_.begin(), names_.end());
  known.insert(without.begin(), without.end());
  std::vector<ListedFile> rest;
  for (const std::string& name : files_below(folder_)) {
    if (!known.contains(name) && name != kName) {
      rest.push_back({name, xxh128_of_file(folder_ / name)});
    }
  }
  add(rest);
}

std::vector<ListedFile> read_manifest(const fs::path& file) {
  const std::string text = read_file(file, FileKind::kTable);
  std::vector<ListedFile> files;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string_view line(text.data() + begin, end - begin);
    if (!is_line(line)) {
      fail("{}:{}: expected 32 hexadecimal digits, two spaces and a file name", file.string(),
           files.size() + 1);
    }
    files.push_back({std::string(line.substr(kDigits + kBetween.size())),
                     std::string(line.substr(0, kDigits))});
  }
  return files;
}

}  // namespace vinebench::harness
