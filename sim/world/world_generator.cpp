// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world_generator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/validate.h"
#include "core/config/yaml_writer.h"
#include "core/util/error.h"
#include "core/util/random.h"
#include "sim/world/row_frame.h"
#include "sim/world/tag_family.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

constexpr double kNarrow = 1.4;   // m; tractors drive in aisles at least so wide, and grass grows
constexpr double kHeadland = 30;  // m of ground beyond the rows, on either side

WorldConfig::Trellis trellis_for(const WorldRecipe& recipe) {
  WorldConfig::Trellis trellis;
  // Every few vines a post, about 5 m apart.
  trellis.post_spacing =
      recipe.plant_spacing * std::max(1.0, std::round(5.0 / recipe.plant_spacing));
  trellis.post_height = 1.9;
  trellis.post_radius = 0.04;
  trellis.wires = {0.75, 1.05, 1.35, 1.65};
  trellis.end_post_radius = 0.06;
  trellis.end_lean_deg = 15;
  trellis.end_brace = WorldConfig::Trellis::Brace::kAnchor;
  trellis.drip_line = 0.45;
  return trellis;
}

WorldConfig::Ground ground_for(const WorldRecipe& recipe) {
  WorldConfig::Ground ground;
  if (recipe.row_spacing < kNarrow) return ground;
  ground.aisles = WorldConfig::Ground::Aisles::kGrass;
  ground.bare_strip = std::min(0.8, 0.32 * recipe.row_spacing);
  ground.track_width = std::min(0.28, 0.12 * recipe.row_spacing);
  ground.track_gauge =
      std::min(1.25, recipe.row_spacing - ground.bare_strip - ground.track_width - 0.1);
  return ground;
}

WorldConfig::Terrain terrain_for(const WorldRecipe& recipe) {
  WorldConfig::Terrain terrain;
  terrain.seed = recipe.seed;
  terrain.slope_percent = recipe.slope_percent;
  const RandomStream random(static_cast<std::uint64_t>(recipe.seed), "slope");
  terrain.slope_heading_deg = std::round(random.uniform(0, 0, 360));
  if (recipe.terrain == WorldRecipe::Relief::kEven) return terrain;
  const bool rough = recipe.terrain == WorldRecipe::Relief::kRough;
  terrain.amplitude = rough ? 0.07 : 0.03;
  terrain.wavelength = rough ? 2.5 : 4;
  terrain.rut_depth = recipe.row_spacing < kNarrow ? 0 : (rough ? 0.03 : 0.015);
  return terrain;
}

std::vector<WorldConfig::Tag> tags_for(const WorldRecipe& recipe,
                                       const std::vector<TrellisPost>& posts) {
  using Side = WorldConfig::PostSide::Side;
  std::vector<WorldConfig::Tag> tags;
  if (recipe.tags == WorldRecipe::Tags::kNone) return tags;
  for (const TrellisPost& post : posts) {
    if (recipe.tags == WorldRecipe::Tags::kFirst && !tags.empty()) break;
    if (recipe.tags == WorldRecipe::Tags::kEnds && !post.end) continue;
    WorldConfig::Tag tag;
    tag.family = recipe.tag_family;
    tag.id = static_cast<int>(tags.size());
    tag.size = recipe.tag_size;
    tag.post = WorldConfig::PostSide{post.row, post.index, Side::kRight, 0.5};
    tags.push_back(std::move(tag));
  }
  const int known = TagFamily(recipe.tag_family).size();
  if (static_cast<int>(tags.size()) > known) {
    fail("world {}: tags: expected at most {} of {}, found {}", recipe.name, known,
         recipe.tag_family, tags.size());
  }
  return tags;
}

/// A place in an aisle, off its middle, that leaves the rover a way past where the aisle is wide.
Eigen::Vector2d somewhere(const WorldRecipe& recipe, const RowFrame& frame,
                          RandomSequence& random) {
  const int aisle = random.below(std::max(1, recipe.rows - 1));
  const double side = random.below(2) == 0 ? -1 : 1;
  const double off = side * random.uniform(0.12, 0.22) * recipe.row_spacing;
  const double along = random.uniform(1, std::max(1.0, recipe.length - 1));
  const Eigen::Vector2d at = frame.to_world({along, (aisle + 0.5) * recipe.row_spacing + off});
  return (at * 100).array().round() / 100;  // cm: whoever reads the file will thank us
}

void add_cartons(WorldConfig& world, const WorldRecipe& recipe, const RowFrame& frame) {
  RandomSequence random(RandomStream(static_cast<std::uint64_t>(recipe.seed), "cartons"));
  for (int i = 0; i < recipe.cartons; ++i) {
    Occluder box;
    box.name = fmt::format("carton {}", i);
    box.position = somewhere(recipe, frame, random);
    box.yaw_deg = std::round(random.uniform(-180, 180));
    const double size = random.uniform(0.8, 1.2);
    box.size = ((size * Eigen::Vector3d(50, 35, 40)).array().round() / 100).matrix();
    box.printed = i % 2 == 1;
    box.print_seed = i;
    world.occluders.push_back(std::move(box));
  }
}

void add_people(WorldConfig& world, const WorldRecipe& recipe, const RowFrame& frame) {
  RandomSequence random(RandomStream(static_cast<std::uint64_t>(recipe.seed), "people"));
  for (int i = 0; i < recipe.people; ++i) {
    Occluder person;
    person.shape = Occluder::Shape::kPerson;
    person.position = somewhere(recipe, frame, random);
    person.yaw_deg = std::round(random.uniform(-180, 180));
    person.height = std::round(random.uniform(160, 186)) / 100;
    Eigen::Vector3d& shirt = person.colour.emplace();
    for (int c = 0; c < 3; ++c) shirt[c] = std::round(random.uniform(10, 75)) / 100;
    world.occluders.push_back(person);
  }
}

}  // namespace

WorldConfig make_world(const WorldRecipe& recipe) {
  validate(recipe);
  WorldConfig world;
  world.name = recipe.name;
  world.block = WorldConfig::Block{recipe.rows, recipe.length, recipe.row_spacing,
                                   recipe.heading_deg, Eigen::Vector2d::Zero()};
  const double width = (recipe.rows - 1) * recipe.row_spacing;
  world.ground_size = std::ceil(std::hypot(recipe.length, width) + 2 * kHeadland);
  world.vines.spacing = recipe.plant_spacing;
  world.vines.bbch = recipe.bbch;
  world.vines.lowest_bunch = 0.70;
  world.vines.canopy_top = 1.9;
  world.vines.canopy_depth = 0.40;
  world.vines.templates = recipe.templates;
  world.trellis = trellis_for(recipe);
  world.terrain = terrain_for(recipe);
  world.ground = ground_for(recipe);

  const WorldLayout layout = lay_out(world);
  world.tags = tags_for(recipe, layout.posts);
  const RowFrame& frame = layout.terrain.frame();
  add_cartons(world, recipe, frame);
  add_people(world, recipe, frame);
  world.tags = written_out(world).tags;  // with their positions, for whoever reads the file
  validate(world);
  return world;
}

std::string format_world(const WorldRecipe& recipe) {
  return fmt::format(
      "# SPDX-FileCopyrightText: Vinebench authors\n# SPDX-License-Identifier: Apache-2.0\n\n"
      "# Made by `vinebench world {}` from seed {}. m, degrees.\n{}",
      recipe.name, recipe.seed, format_yaml(make_world(recipe)));
}

}  // namespace vinebench::sim
