// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace vinebench::harness {

/// Pictures of a run for a page.
struct FilmPictures {
  nlohmann::ordered_json index;     ///< as film.json (harness/run/film.h)
  nlohmann::ordered_json pictures;  ///< JPEG in base64, in the order of the index' pictures
  std::size_t bytes = 0;            ///< of these
};

/// As many pictures of a run's film as fit, evenly spread; of a run without a film, its frames'
/// images. Empty if there are none, or not even two fit. Throws Error for a damaged file, which it
/// names.
std::optional<FilmPictures> film_pictures(const std::filesystem::path& run, std::size_t budget);

}  // namespace vinebench::harness
