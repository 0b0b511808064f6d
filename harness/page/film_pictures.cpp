// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/film_pictures.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/files/files.h"
#include "core/util/base64.h"
#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/files/json_file.h"
#include "harness/report/timeline.h"
#include "harness/run/film.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Picture {
  Json entry;            ///< of the index
  std::size_t size = 0;  ///< bytes in base64
  fs::path file{};
  std::string jpg{};  ///< base64, of a picture without a file
};

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

/// Every name is one that the film gives: nothing outside its folder is read.
Picture picture_of(const Json& entry, const fs::path& index) {
  if (!entry.is_object() || !entry.contains("frame") || !entry["frame"].is_number_integer()) {
    fail("{}: expected the index of a film, found a picture without frame", index.string());
  }
  const fs::path file =
      index.parent_path() / fmt::format("{:06}.jpg", entry["frame"].get<std::int64_t>());
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  if (error) fail("{}: {}", file.string(), error.message());
  return {entry, (bytes + 2) / 3 * 4, file};
}

/// Of the film that the run has kept.
std::vector<Picture> kept_film(const fs::path& index, Json& layout) {
  layout = read_json(index);
  if (!layout.is_object() || !layout.contains("pictures") || !layout["pictures"].is_array()) {
    fail("{}: expected the index of a film, found no list of pictures", index.string());
  }
  std::vector<Picture> pictures;
  for (const Json& entry : layout["pictures"]) pictures.push_back(picture_of(entry, index));
  return pictures;
}

std::vector<FilmLayout::Camera> cameras_of(const fs::path& file) {
  const Json site = read_json(file);
  std::vector<FilmLayout::Camera> cameras;
  try {
    for (const Json& camera : site.at("cameras")) {
      cameras.push_back({camera.at("name"), camera.at("width"), camera.at("height")});
      if (cameras.back().width < 1 || cameras.back().height < 1) {
        fail("{}: expected cameras with a width and a height", file.string());
      }
    }
  } catch (const Json::exception& error) {
    fail("{}: expected cameras with name, width and height: {}", file.string(), error.what());
  }
  return cameras;
}

std::set<std::int64_t> frames_in(const fs::path& folder) {
  std::set<std::int64_t> frames;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const std::size_t digits = name.find_first_not_of("0123456789");
    if (digits >= 6 && digits < 16 && name.ends_with(".png")) {
      frames.insert(std::stoll(name.substr(0, digits)));
    }
  }
  return frames;
}

/// Of the few frames whose images every run keeps.
std::vector<Picture> film_of_frames(const fs::path& run, Json& layout) {
  if (!is_file(run / kSiteFile)) return {};
  const std::vector<FilmLayout::Camera> cameras = cameras_of(run / kSiteFile);
  const FilmLayout film(cameras);
  layout = film.json();
  std::vector<Picture> pictures;
  for (const std::int64_t frame : frames_in(run / "frames")) {
    std::vector<cv::Mat> images;
    for (const FilmLayout::Camera& camera : cameras) {
      const fs::path file = run / "frames" / fmt::format("{:06}_{}.png", frame, camera.name);
      images.emplace_back();
      if (!is_file(file)) continue;
      const cv::Mat bgr = read_image(file, cv::IMREAD_COLOR);
      if (bgr.empty()) fail("{}: damaged", file.string());
      cv::cvtColor(bgr, images.back(), cv::COLOR_BGR2RGB);
    }
    const std::vector<std::uint8_t> bytes = film.picture(images);
    std::string jpg = base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    pictures.push_back({{{"frame", frame}}, jpg.size(), {}, std::move(jpg)});
  }
  return pictures;
}

std::size_t bytes_of_every(const std::vector<Picture>& pictures, std::size_t step) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < pictures.size(); i += step) bytes += pictures[i].size;
  return bytes;
}

}  // namespace

std::optional<FilmPictures> film_pictures(const fs::path& run, std::size_t budget) {
  FilmPictures film;
  const fs::path index = run / kFilmFolder / kFilmIndex;
  const std::vector<Picture> all =
      is_file(index) ? kept_film(index, film.index) : film_of_frames(run, film.index);
  std::size_t step = 1;
  while (step < all.size() && bytes_of_every(all, step) > budget) ++step;
  if (all.size() < 2 || step >= all.size()) return std::nullopt;
  film.bytes = bytes_of_every(all, step);
  film.index["pictures"] = film.pictures = Json::array();
  for (std::size_t i = 0; i < all.size(); i += step) {
    film.index["pictures"].push_back(all[i].entry);
    film.pictures.push_back(all[i].file.empty() ? all[i].jpg
                                                : base64(read_file(all[i].file, FileKind::kImage)));
  }
  return film;
}

}  // namespace vinebench::harness
