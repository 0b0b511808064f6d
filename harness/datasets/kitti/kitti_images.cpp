// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_images.h"

#include <algorithm>
#include <system_error>

#include "core/util/error.h"

namespace vinebench::harness {

namespace fs = std::filesystem;

std::map<std::int64_t, fs::path> numbered_files(const fs::path& folder,
                                                const std::vector<std::string>& kinds) {
  std::error_code error;
  std::map<std::int64_t, fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string stem = entry.path().stem().string();
    const bool number = !stem.empty() && stem.size() <= 18 &&
                        stem.find_first_not_of("0123456789") == std::string::npos;
    if (number && std::ranges::count(kinds, entry.path().extension().string()) > 0) {
      files[std::stoll(stem)] = entry.path();
    }
  }
  if (error) fail("{}: cannot be read: {}", folder.string(), error.message());
  return files;
}

std::map<std::int64_t, fs::path> images_in(const fs::path& folder) {
  auto images = numbered_files(folder, {".png", ".jpg", ".jpeg", ".pgm", ".bmp", ".tif", ".webp"});
  if (images.empty()) {
    fail("{}: expected images named by their number, such as 000000.png, found none",
         folder.string());
  }
  return images;
}

}  // namespace vinebench::harness
