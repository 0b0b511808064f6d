// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "harness/run/film_layout.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// In a run's folder, with pictures 000123.jpg and their index, film.json.
inline constexpr const char* kFilmFolder = "film";
inline constexpr const char* kFilmIndex = "film.json";

/// Keeps small pictures of a run for its report: of every n-th frame one JPEG with the images of
/// all cameras side by side, and what the SLAM system saw in them. Throws Error with the system's
/// reason if a file cannot be written.
class Film : public Sink {
 public:
  static constexpr std::int64_t kMostPictures = 400;

  using Features = std::function<std::vector<SupportingFeature>()>;

  /// Of a run of `total` frames. `features` are asked for after each frame that is kept; empty if
  /// the system does not tell.
  Film(std::filesystem::path run, const Rig& rig, std::int64_t total, Features features = {});
  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;

 private:
  std::filesystem::path folder_;
  std::int64_t every_;
  Features features_;
  FilmLayout layout_;
  nlohmann::ordered_json pictures_ = nlohmann::ordered_json::array();
};

/// How the film of a rig is laid out.
FilmLayout film_layout(const Rig& rig);

/// What a SLAM system saw in a picture, by the indices of its cells and in their pixels:
/// `features`, of each cell x, y, x, y, ...; `tags` with `camera`, `id` and `corners`.
nlohmann::ordered_json seen_json(const FilmLayout& layout,
                                 const std::vector<SupportingFeature>& features,
                                 const std::vector<TagSighting>& tags);

}  // namespace vinebench::harness
