// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/picture_set.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kLeastSize = 64;  // px

bool is_picture(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".jpg" || ending == ".jpeg" || ending == ".png";
}

/// In the order of their names.
std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (it->is_regular_file() && is_picture(it->path())) files.push_back(it->path());
  }
  if (error) fail("{}: {}", folder.string(), error.message());
  if (files.empty()) fail("{}: expected pictures (.jpg, .png), found none", folder.string());
  std::ranges::sort(files);
  return files;
}

MeasuredPicture measure(const fs::path& file, const fs::path& folder, int width) {
  const fs::path name = fs::relative(file, folder);
  const cv::Mat bgr = read_image(file, cv::IMREAD_COLOR);
  if (bgr.empty()) fail("{}: damaged", file.string());
  if (std::min(bgr.cols, bgr.rows) < kLeastSize) {
    fail("{}: expected at least {} px each way, found {} x {}", file.string(), kLeastSize, bgr.cols,
         bgr.rows);
  }
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  const bool grouped = name.has_parent_path();
  return {name.string(), grouped ? name.begin()->string() : name.string(), file,
          picture_statistics(standard_picture(rgb, width))};
}

}  // namespace

std::vector<double> PictureSet::values(const std::string& statistic) const {
  std::vector<double> values;
  for (const MeasuredPicture& picture : pictures) {
    for (const auto& [key, value] : picture.statistics) {
      if (key == statistic) values.push_back(value);
    }
  }
  return values;
}

std::vector<std::string> PictureSet::statistics() const {
  std::vector<std::string> names;
  for (const MeasuredPicture& picture : pictures) {
    for (const auto& [key, value] : picture.statistics) {
      if (std::ranges::count(names, key) == 0) names.push_back(key);
    }
  }
  return names;
}

PictureSet measure_folder(const fs::path& folder, int width, WorkerPool& pool) {
  const std::vector<fs::path> files = pictures_in(folder);
  PictureSet set{fs::absolute(folder).lexically_normal().filename().string(), width, {}};
  set.pictures.resize(files.size());
  pool.for_each(files.size(),
                [&](std::size_t i) { set.pictures[i] = measure(files[i], folder, width); });
  return set;
}

Json to_json(const PictureSet& set) {
  Json pictures = Json::array();
  for (const MeasuredPicture& picture : set.pictures) {
    Json statistics = Json::object();
    for (const auto& [name, value] : picture.statistics) statistics[name] = value;
    pictures.push_back({{"group", picture.group}, {"statistics", statistics}});
  }
  return {{"pictures_of", set.name}, {"width", set.width}, {"pictures", pictures}};
}

PictureSet read_picture_set(const fs::path& file) {
  const Json json = read_json(file);
  PictureSet set;
  try {
    set.name = json.at("pictures_of").get<std::string>();
    set.width = json.at("width").get<int>();
    for (const Json& entry : json.at("pictures")) {
      MeasuredPicture picture;
      picture.group = entry.at("group").get<std::string>();
      for (const auto& [name, value] : entry.at("statistics").items()) {
        picture.statistics.emplace_back(name, value.get<double>());
      }
      set.pictures.push_back(std::move(picture));
    }
  } catch (const Json::exception& error) {
    fail("{}: expected the numbers of pictures, as `realism --save` writes them: {}", file.string(),
         error.what());
  }
  if (set.pictures.empty()) fail("{}: no pictures", file.string());
  return set;
}

}  // namespace vinebench::harness
