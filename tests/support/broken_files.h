// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>

#include "sim/assets/asset_file.h"
#include "sim/scene/mesh_builder.h"
#include "sim/scene/scene_check.h"
#include "tests/support/test_folder.h"

namespace vinebench::test {

/// A bent trunk with a few blades: two levels, two materials, an image of four by four.
inline sim::Asset small_plant() {
  sim::Asset asset;
  asset.add(sim::Texture{"leaf", cv::Mat(4, 4, CV_8UC4, cv::Scalar(40, 90, 30, 255)), true});
  asset.add(sim::make_material("leaf", Label::kLeaf, 0));
  asset.add(sim::make_material("bark", Label::kTrunk, -1));
  asset.model.name = "plant";
  for (const int sides : {7, 4}) {
    sim::Primitive wood, blades;
    wood.material = 1;
    sim::MeshBuilder(wood).tube(
        {{{0, 0, 0}, {0.02f, 0, 0.4f}, {0, 0, 0.8f}}, {0.03f, 0.02f, 0.02f}}, sides, 1, true);
    sim::MeshBuilder builder(blades);
    for (int i = 0; i < 3; ++i) {
      const auto axes = sim::axes_along({0, static_cast<float>(i), 1}, Eigen::Vector3f::UnitX());
      sim::BladePlacement blade;
      blade.foot = {0.1f * static_cast<float>(i), 0, 0.7f};
      blade.axes = axes;
      blade.shading_normal = axes.z;
      builder.blade(blade, 1);
    }
    asset.model.levels.push_back({sides == 7 ? 3.0 : 1e9, {wood, blades}});
  }
  asset.update_bounds();
  return asset;
}

/// Adds the asset to a scene and checks that all of it can be rendered.
inline void expect_sound(const sim::Asset& asset) {
  sim::Scene scene;
  sim::add_asset(scene, asset);
  EXPECT_NO_THROW(sim::check_scene(scene));
  EXPECT_GT(sim::triangle_count(asset.model.levels.at(0)), 0);
}

/// A broken file is either loaded completely or an error that names it.
class BrokenFiles : public testing::Test {
 protected:
  /// The message for a file of that name and content, which it must name; empty if it loads.
  std::string message(const std::string& name, std::string_view content) const {
    const auto file = folder_.write(name, content);
    std::optional<sim::Asset> asset;
    const std::string error = error_of([&] { asset = sim::load_asset(file); });
    if (asset) {
      expect_sound(*asset);
    } else {
      EXPECT_THAT(error, testing::HasSubstr(file.string()));
      EXPECT_LT(error.size(), 600u);
    }
    return error;
  }

  std::string problem(const std::string& name, std::string_view content) const {
    const std::string error = message(name, content);
    EXPECT_NE(error, "") << name;
    return error;
  }

  TestFolder folder_;
};

}  // namespace vinebench::test
