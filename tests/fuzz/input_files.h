// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/util/error.h"

namespace vinebench::fuzz {

/// Of this process alone, in memory where the system has /dev/shm; removed at the end.
class InputFolder {
 public:
  InputFolder()
      : path_((std::filesystem::exists("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                   : std::filesystem::temp_directory_path()) /
              ("vinebench-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~InputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view content) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline const InputFolder& input_folder() {
  static const InputFolder folder;
  return folder;
}

/// Images that lists in a folder may name, black.
inline bool write_images(const std::vector<std::string>& names, const cv::Size& size) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", cv::Mat::zeros(size, CV_8UC1), bytes);
  for (const std::string& name : names) {
    input_folder().write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  return true;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Calls what reads an input. An Error is the right answer to a broken one; all else, another
/// exception included, ends the fuzzer with the input kept.
template <class Read>
int expect_value_or_error(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
  return 0;
}

/// Reads one file of that name.
template <class Read>
int fuzz_file(const std::uint8_t* data, std::size_t size, const std::string& name,
              const Read& read) {
  const std::filesystem::path file = input_folder().write(name, text_of(data, size));
  return expect_value_or_error([&] { read(file); });
}

/// Reads a folder: the input's parts, between lines of "%%", are the files of those names; files
/// without a part do not exist.
template <class Read>
int fuzz_folder(const std::uint8_t* data, std::size_t size, const std::vector<std::string>& names,
                const Read& read) {
  constexpr std::string_view kBetween = "%%\n";
  std::string_view rest = text_of(data, size);
  for (const std::string& name : names) {
    if (rest.empty()) {
      std::filesystem::remove(input_folder().path() / name);
      continue;
    }
    const std::size_t end = rest.find(kBetween);
    input_folder().write(name, rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + kBetween.size());
  }
  return expect_value_or_error([&] { read(input_folder().path()); });
}

}  // namespace vinebench::fuzz
