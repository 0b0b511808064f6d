// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/props.h"

#include <gtest/gtest.h>

#include "sim/world/tag_family.h"

namespace vinebench::sim {
namespace {

TEST(TagTest, ThePrintLiesInThePlaneOfTheTagAndTheBoardBehindIt) {
  WorldConfig world;
  world.rows = {{{0, 0}, {6, 0}}};
  world.tags.resize(1);
  world.tags[0].size = 0.16;
  Scene scene;
  add_tags(scene, world, lay_out(world));
  const Model& model = scene.models.at(0);
  // 10 modules and a rim of one on either side, of which 8 make the black square: 0.16 * 12 / 8.
  EXPECT_NEAR(model.bounds.sizes().x(), 0.24, 1e-6);
  EXPECT_NEAR(model.bounds.min().z(), 0, 1e-6);
  EXPECT_NEAR(model.bounds.max().z(), kTagBoardThickness, 1e-6);
  for (const Material& material : scene.materials) EXPECT_EQ(material.label, Label::kTag);
}

}  // namespace
}  // namespace vinebench::sim
