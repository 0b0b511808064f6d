// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/rover_asset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

const std::filesystem::path kRoverModel =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rover.xml";

TEST(RoverAssetTest, HasTheModelsMeasures) {
  const Asset rover = rover_asset(kRoverModel);
  // The collision hull is not visible; the wheels extend furthest: 0.15 + 0.10 m ahead, and to the
  // side 0.19 m and the rollers' 0.0623 m of half length at 45 degrees.
  EXPECT_NEAR(rover.model.bounds.max().y(), 0.236f, 0.005f);
  EXPECT_NEAR(rover.model.bounds.max().x(), 0.25f, 0.005f);
  EXPECT_NEAR(rover.model.bounds.max().z(), 0.505f, 1e-4f);  // the camera bar's top
  EXPECT_NEAR(rover.model.bounds.min().z(), 0, 0.003f);      // rollers on the ground
  for (const Material& material : rover.materials) EXPECT_EQ(material.label, Label::kRover);
}

/// Faces look outward: the volume by the divergence theorem is that of the shape.
TEST(RoverAssetTest, ShapesHaveTheirVolume) {
  const test::TestFolder folder;
  const auto volume = [&](const std::string& geom) {
    const Asset asset = rover_asset(folder.write(
        "rover.xml", "<mujoco><worldbody><body pos='1 2 3'><freejoint name='chassis'/><geom " +
                         geom + "/></body></worldbody></mujoco>"));
    double six_volumes = 0;
    for (const Primitive& part : asset.model.levels.front().primitives) {
      for (std::size_t i = 0; i < part.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) {
          return part.vertices[part.indices[i + k]].position.cast<double>();
        };
        six_volumes += p(0).dot(p(1).cross(p(2)));
      }
    }
    return six_volumes / 6;
  };
  using std::numbers::pi;
  EXPECT_NEAR(volume("type='box' size='0.1 0.2 0.3'"), 8 * 0.006, 1e-6);
  // Round shapes are inscribed polyhedra: of 8 to 20 sides, 2 to 20 % smaller.
  const auto expect_round = [&](double found, double exact) {
    EXPECT_LT(found, exact);
    EXPECT_GT(found, 0.78 * exact);
  };
  expect_round(volume("type='cylinder' size='0.1 0.2'"), pi * 0.01 * 0.4);
  expect_round(volume("type='sphere' size='0.1'"), 4 / 3.0 * pi * 0.001);
  expect_round(volume("type='ellipsoid' size='0.1 0.2 0.3'"), 4 / 3.0 * pi * 0.006);
  expect_round(volume("type='capsule' size='0.1 0.2'"), pi * 0.01 * (0.4 + 4 / 3.0 * 0.1));
}

TEST(RoverAssetTest, WhatIsNoRoverIsAnError) {
  const test::TestFolder folder;
  const auto error_of = [&](const std::filesystem::path& file) {
    try {
      rover_asset(file);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(error_of(folder / "none.xml"), HasSubstr("none.xml"));
  EXPECT_THAT(error_of(folder.write("a.xml", "<mujoco/>")), HasSubstr("chassis"));
  EXPECT_THAT(error_of(folder.write("b.xml",
                                    "<mujoco><worldbody><body><freejoint name='chassis'/><geom "
                                    "size='1' group='3'/></body></worldbody></mujoco>")),
              HasSubstr("no visible geom"));
}

}  // namespace
}  // namespace vinebench::sim
