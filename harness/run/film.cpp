// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/film.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "harness/datasets/files/json_file.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// Of each cell x, y, x, y, ...
Json features_json(const FilmLayout& layout, const std::vector<SupportingFeature>& features) {
  Json cells = Json::array();
  for (std::size_t i = 0; i < layout.cells().size(); ++i) cells.push_back(Json::array());
  for (const SupportingFeature& feature : features) {
    const auto camera = static_cast<std::size_t>(feature.camera);
    const FilmLayout::Cell& cell = layout.cells().at(camera);
    cells[camera].push_back(cell.in_cell(feature.pixel.x()));
    cells[camera].push_back(cell.in_cell(feature.pixel.y()));
  }
  return cells;
}

Json tags_json(const FilmLayout& layout, const std::vector<TagSighting>& sightings) {
  Json tags = Json::array();
  for (const TagSighting& tag : sightings) {
    const FilmLayout::Cell& cell = layout.cells().at(static_cast<std::size_t>(tag.camera));
    Json corners = Json::array();
    for (const Eigen::Vector2d& corner : tag.corners) {
      corners.push_back(cell.in_cell(corner.x()));
      corners.push_back(cell.in_cell(corner.y()));
    }
    tags.push_back({{"camera", tag.camera}, {"id", tag.id}, {"corners", corners}});
  }
  return tags;
}

}  // namespace

Json seen_json(const FilmLayout& layout, const std::vector<SupportingFeature>& features,
               const std::vector<TagSighting>& tags) {
  return {{"features", features_json(layout, features)}, {"tags", tags_json(layout, tags)}};
}

FilmLayout film_layout(const Rig& rig) {
  std::vector<FilmLayout::Camera> cameras;
  for (const RigCamera& camera : rig.cameras) {
    cameras.push_back({camera.name, camera.model.width, camera.model.height});
  }
  return FilmLayout(cameras);
}

Film::Film(std::filesystem::path run, const Rig& rig, std::int64_t total, Features features)
    : folder_(std::move(run) / kFilmFolder),
      every_(std::max<std::int64_t>(1, (total + kMostPictures - 1) / kMostPictures)),
      features_(std::move(features)),
      layout_(film_layout(rig)) {
  create_inner_folder(folder_);
}

void Film::on_tick(const Sample& sample, const Estimate& estimate) {
  const std::int64_t index = sample.frame.index;
  if (index % every_ != 0) return;
  const std::vector<std::uint8_t> bytes = layout_.picture(sample.frame.images);
  write_file_atomically(folder_ / fmt::format("{:06}.jpg", index),
                        {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  Json picture{{"frame", index}};
  picture.update(seen_json(layout_, features_ ? features_() : std::vector<SupportingFeature>(),
                           estimate.tags));
  pictures_.push_back(std::move(picture));
}

void Film::on_finish(const SlamSummary&) {
  Json index = layout_.json();
  index["pictures"] = pictures_;
  write_file_atomically(folder_ / kFilmIndex, json_text(index) + "\n");
}

}  // namespace vinebench::harness
