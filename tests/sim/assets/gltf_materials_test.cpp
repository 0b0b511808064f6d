// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/gltf_materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two materials with one image between them, whose file is missing, and one without.
tinygltf::Model two_skins() {
  tinygltf::Model model;
  model.images.resize(1);
  model.images[0].uri = "gone.png";
  model.textures.resize(1);
  model.textures[0].source = 0;
  model.materials.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    model.materials[i].name = std::string(1, static_cast<char>('a' + i));
    model.materials[i].alphaMode = "OPAQUE";
    model.materials[i].pbrMetallicRoughness.baseColorTexture.index = i < 2 ? 0 : -1;
  }
  return model;
}

TEST(GltfMaterialsTest, EachMaterialWithoutItsImageIsNoted) {
  DecodedImages images;
  ImportedMesh mesh;
  read_gltf_materials(two_skins(), "vine.gltf", Strictness::kLenient, images, mesh);
  const auto note = [](const char* name) {
    return AllOf(HasSubstr("material '" + std::string(name) + "' is drawn in its colour alone"),
                 HasSubstr("gone.png"), testing::Not(HasSubstr("vine.gltf")));
  };
  EXPECT_THAT(mesh.notes.all(), ElementsAre(note("a"), note("b")));
  ASSERT_EQ(mesh.asset.materials.size(), 3u);
  for (const Material& material : mesh.asset.materials) EXPECT_EQ(material.texture, -1);
}

TEST(GltfMaterialsTest, StrictlyEveryImageMustBeReadElseOnlyThoseThatAreDrawn) {
  tinygltf::Model model = two_skins();
  for (tinygltf::Material& material : model.materials) {
    material.pbrMetallicRoughness.baseColorTexture.index = -1;
  }
  DecodedImages images;
  ImportedMesh mesh;
  EXPECT_THAT(error_of([&] { read_gltf_materials(model, "f", Strictness::kStrict, images, mesh); }),
              HasSubstr("gone.png"));
  read_gltf_materials(model, "f", Strictness::kLenient, images, mesh);
  EXPECT_THAT(mesh.notes.all(), testing::IsEmpty());
}

TEST(GltfMaterialsTest, LooksThatAreNotDrawnAreNoted) {
  tinygltf::Model model = two_skins();
  model.materials.resize(1);
  tinygltf::Material& material = model.materials[0];
  material.pbrMetallicRoughness.baseColorTexture.index = -1;
  material.pbrMetallicRoughness.metallicRoughnessTexture.index = 0;
  material.normalTexture.index = material.emissiveTexture.index = 0;
  material.occlusionTexture.index = 0;
  material.alphaMode = "BLEND";
  DecodedImages images;
  ImportedMesh mesh;
  read_gltf_materials(model, "f", Strictness::kLenient, images, mesh);
  EXPECT_THAT(mesh.notes.all(),
              testing::UnorderedElementsAre(
                  HasSubstr("'a': its image of normals"), HasSubstr("'a': its image of emission"),
                  HasSubstr("'a': its image of occlusion"),
                  HasSubstr("'a': its image of roughness"), HasSubstr("'a': it is cut out")));
}

TEST(GltfMaterialsTest, LabelsOfTheFileAreKnown) {
  tinygltf::Model model = two_skins();
  model.materials.erase(model.materials.begin(), model.materials.begin() + 1);
  using tinygltf::Value;
  model.materials[1].extras = Value(Value::Object{{"label", Value(std::string("trunk"))}});
  DecodedImages images;
  ImportedMesh mesh;
  read_gltf_materials(model, "f", Strictness::kLenient, images, mesh);
  EXPECT_THAT(mesh.labelled, ElementsAre(1));
  EXPECT_EQ(mesh.asset.materials[1].label, Label::kTrunk);
}

}  // namespace
}  // namespace vinebench::sim
