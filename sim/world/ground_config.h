// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/config/config_field.h"

namespace vinebench::sim {

/// The ground's shape: a slope with bumps on it, and ruts where wheels run.
struct TerrainConfig {
  std::int64_t seed = 1;         ///< of the unevenness
  double amplitude = 0;          ///< m, of the largest bumps up or down; 0 is even ground
  double wavelength = 3;         ///< m, from bump to bump
  double rut_depth = 0;          ///< m, of the wheel tracks
  double slope_percent = 0;      ///< rise over run
  double slope_heading_deg = 0;  ///< uphill, from east over north
  double cell = 0.1;             ///< m, side of a cell of the height field
  double margin = 6;             ///< m of ground round the rows that is shaped and can be driven on
  bool flat() const { return amplitude == 0 && rut_depth == 0 && slope_percent == 0; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("seed", seed, Range::non_negative());
    archive("amplitude", amplitude, Range::between(0, 0.5));
    archive("wavelength", wavelength, Range::between(0.5, 100));
    archive("rut_depth", rut_depth, Range::between(0, 0.3));
    archive("slope_percent", slope_percent, Range::between(0, 30));
    archive("slope_heading_deg", slope_heading_deg, Range::between(-360, 360));
    archive("cell", cell, Range::between(0.05, 0.5));
    archive("margin", margin, Range::between(2, 30));
  }
};

/// What covers the ground.
struct GroundConfig {
  enum class Aisles { kSoil, kGrass };
  Aisles aisles = Aisles::kSoil;  ///< what is between the rows
  double bare_strip = 0.8;        ///< m, width of the strip without grass under the vines
  double track_gauge = 1.25;      ///< m between the middles of the wheel tracks
  double track_width = 0.28;      ///< m
  friend std::vector<std::string> yaml_names(Aisles) { return {"soil", "grass"}; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("aisles", aisles);
    archive("bare_strip", bare_strip, Range::between(0, 5));
    archive("track_gauge", track_gauge, Range::between(0, 5));
    archive("track_width", track_width, Range::between(0.05, 2));
  }
};

}  // namespace vinebench::sim
