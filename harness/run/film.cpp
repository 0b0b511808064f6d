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

}  // namespace

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
  pictures_.push_back(
      {{"frame", index}, {"features", features_json()}, {"tags", tags_json(estimate)}});
}

void Film::on_finish(const SlamSummary&) {
  Json index = layout_.json();
  index["pictures"] = pictures_;
  write_file_atomically(folder_ / kFilmIndex, json_text(index) + "\n");
}

/// Of each camera x, y, x, y, ... in pixels of its cell.
Json Film::features_json() const {
  Json cameras = Json::array();
  for (std::size_t i = 0; i < layout_.cells().size(); ++i) cameras.push_back(Json::array());
  if (!features_) return cameras;
  for (const SupportingFeature& feature : features_()) {
    const auto camera = static_cast<std::size_t>(feature.camera);
    const FilmLayout::Cell& cell = layout_.cells().at(camera);
    cameras[camera].push_back(cell.in_cell(feature.pixel.x()));
    cameras[camera].push_back(cell.in_cell(feature.pixel.y()));
  }
  return cameras;
}

Json Film::tags_json(const Estimate& estimate) const {
  Json tags = Json::array();
  for (const TagSighting& tag : estimate.tags) {
    const FilmLayout::Cell& cell = layout_.cells().at(static_cast<std::size_t>(tag.camera));
    Json corners = Json::array();
    for (const Eigen::Vector2d& corner : tag.corners) {
      corners.push_back(cell.in_cell(corner.x()));
      corners.push_back(cell.in_cell(corner.y()));
    }
    tags.push_back({{"camera", tag.camera}, {"id", tag.id}, {"corners", corners}});
  }
  return tags;
}

}  // namespace vinebench::harness
