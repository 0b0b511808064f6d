// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/assets/asset_file.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One triangle of one material.
Asset triangle(Label label) {
  Asset asset;
  asset.add(make_material("skin", label, -1));
  Primitive primitive;
  for (const Eigen::Vector3f& at :
       {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, 2)}) {
    primitive.vertices.push_back({at, -Eigen::Vector3f::UnitY()});
  }
  primitive.indices = {0, 1, 2};
  asset.model.levels = {{1e9, {primitive}}};
  return asset;
}

TEST(GltfWriterTest, LabelsAreStoredByName) {
  const test::TestFolder folder;
  for (std::size_t i = 0; i < kLabels; ++i) {
    const auto label = static_cast<Label>(i);
    const std::string bytes = to_glb(triangle(label));
    EXPECT_THAT(bytes, HasSubstr(R"("label":")" + std::string(name_of(label)) + "\""));
    const Asset back = load_asset(folder.write("a.glb", bytes));
    EXPECT_EQ(back.materials.at(0).label, label);
  }
}

TEST(GltfWriterTest, HeightIsTheFilesY) {
  // (0, 0, 2) with z up is (0, 2, 0) with y up; the largest of each axis stands beside positions.
  EXPECT_THAT(to_glb(triangle(Label::kPost)), HasSubstr(R"("max":[1.0,2.0,)"));
}

TEST(GltfWriterTest, OnlyLevelsOfDetailNeedTheExtension) {
  Asset asset = triangle(Label::kPost);
  EXPECT_THAT(to_glb(asset), Not(HasSubstr("MSFT_lod")));
  asset.model.levels = {{2.5, asset.model.levels[0].primitives}, asset.model.levels[0]};
  EXPECT_THAT(to_glb(asset), AllOf(HasSubstr(R"("extensionsUsed":["MSFT_lod"])"),
                                   HasSubstr(R"("until":[2.5,1000000000.0])")));
}

TEST(GltfWriterTest, ANameThatIsNoUtf8IsAnError) {
  Asset asset = triangle(Label::kPost);
  asset.model.name = "\xff";
  EXPECT_THAT(test::error_of([&] { to_glb(asset); }), HasSubstr(".glb cannot be written"));
}

}  // namespace
}  // namespace vinebench::sim
