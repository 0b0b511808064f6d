// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/world/world.h"

namespace vinebench::sim {

/// The parameters of a generated vineyard.
struct WorldRecipe {
  enum class Relief { kEven, kGentle, kRough };
  enum class Tags { kNone, kFirst, kEnds, kPosts };

  std::string name = "vineyard";
  int rows = 10;
  double length = 30;          ///< m, of a row
  double row_spacing = 2.5;    ///< m
  double plant_spacing = 1.0;  ///< m
  double heading_deg = 0;      ///< of the rows, counter-clockwise from east
  Relief terrain = Relief::kGentle;
  double slope_percent = 0;  ///< in a direction drawn by seed
  int bbch = 89;             ///< growth stage
  int templates = 8;         ///< different plants
  Tags tags = Tags::kEnds;   ///< one in all, one at every row's end, one on every post
  std::string tag_family = "tag36h11";
  double tag_size = 0.161;  ///< m, side of the black square
  int cartons = 0;          ///< in the aisles, alternately plain and printed
  int people = 0;           ///< likewise
  std::int64_t seed = 1;    ///< of ground, slope, cartons and people

  friend std::vector<std::string> yaml_names(Relief) { return {"even", "gentle", "rough"}; }
  friend std::vector<std::string> yaml_names(Tags) { return {"none", "first", "ends", "posts"}; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("rows", rows, Range::between(1, 200));
    archive("length", length, Range::between(1, 500));
    archive("row_spacing", row_spacing, Range::between(0.6, 10));
    archive("plant_spacing", plant_spacing, Range::between(0.3, 10));
    archive("heading_deg", heading_deg, Range::between(-360, 360));
    archive("terrain", terrain);
    archive("slope_percent", slope_percent, Range::between(0, 30));
    archive("bbch", bbch, Range::between(0, 99));
    archive("templates", templates, Range::between(1, 64));
    archive("tags", tags);
    archive("tag_family", tag_family);
    archive("tag_size", tag_size, Range::between(0.02, 1));
    archive("cartons", cartons, Range::between(0, 500));
    archive("people", people, Range::between(0, 100));
    archive("seed", seed, Range::non_negative());
    const bool named = !name.empty() && name.find_first_of("/\n\"\\") == std::string::npos;
    archive.require(named, "name", "expected a name without '/', quotes or line breaks");
    archive.require(length >= plant_spacing, "length", "expected at least plant_spacing");
    const std::string problem = WorldConfig::tag_problem(tag_family, 0);
    archive.require(problem.empty(), "tag_family", problem);
  }
};

/// The world of a recipe: its rows are a block. Trellis and strips have common
/// values, adapted to the aisles' width. Throws Error that lists the violations.
WorldConfig make_world(const WorldRecipe& recipe);

/// The YAML text of that world. Reading it gives the same world.
std::string format_world(const WorldRecipe& recipe);

}  // namespace vinebench::sim
