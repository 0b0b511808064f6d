// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sim/assets/asset_file.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

/// A .gltf of one triangle of a material with these extras.
std::string with_extras(const std::string& extras) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("materials":[{"extras":{)" +
         extras +
         R"(}}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")"
         // Corners (0, 0, 0), (1, 0, 0), (0, 2, 0) as nine little-endian floats.
         R"(data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}]})";
}

Material material_of(const std::string& extras) {
  const test::TestFolder folder;
  return load_asset(folder.write("a.gltf", with_extras(extras))).materials.at(0);
}

TEST(GltfReaderTest, ALabelIsReadByItsName) {
  EXPECT_EQ(material_of(R"("label":"bunch")").label, Label::kBunch);
  EXPECT_EQ(material_of(R"("label":"person")").label, Label::kPerson);
}

TEST(GltfReaderTest, WithoutALabelAMaterialIsALeaf) {
  EXPECT_EQ(material_of("").label, Label::kLeaf);
}

// Earlier files hold numbers of the labels as they were then: sky, ground, grass, trunk, ...
TEST(GltfReaderTest, EarlierFilesNumbersKeepTheirMeaning) {
  EXPECT_EQ(material_of(R"("label":3)").label, Label::kTrunk);
  EXPECT_EQ(material_of(R"("label":10)").label, Label::kBox);
  EXPECT_EQ(material_of(R"("label":12)").label, Label::kPerson);
}

}  // namespace
}  // namespace vinebench::sim
